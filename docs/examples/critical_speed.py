# %% [markdown]
# # At which wind speed does a photovoltaic panel become unstable?
#
# The panel of `config/examples/photovoltaic_panel.yaml`: 1 m by 6 m, 15 kg/m2, held at both ends.
# Run it in the folder of a clone, as a notebook or by `python docs/examples/critical_speed.py`.

# %%
import matplotlib.pyplot as plt
import numpy as np

import equisection as eq

beam = eq.Beam.from_yaml("config/examples/photovoltaic_panel.yaml")
section = eq.reduce(beam, method="beam")
polar = eq.Polar.read("config/polars/plate_2d_11136.csv")
print(f"{section.mass:.1f} kg and {section.torsional_stiffness:.0f} N m/rad per metre of span")

# %% [markdown]
# ## The onset at one incidence

# %%
onset = eq.critical_speed(section, polar, incidence_deg=2.5, speed=(5.0, 80.0))
print(
    f"{onset.mechanism.item()} at {onset.critical_speed.item():.1f} m/s with "
    f"{onset.frequency.item():.2f} Hz, k* = {onset.k_star.item():.2f}"
)

# %% [markdown]
# ## The motion below and above it

# %%
for speed in (35.0, 45.0):
    motion = eq.release(section, polar, incidence_deg=2.5, speed=speed)
    print(f"{speed:.0f} m/s: {motion.attrs['regime']} after {motion.time[-1].item():.1f} s")

# %% [markdown]
# ## The onset over incidence, and the growth at 2.5 deg

# %%
angles = np.arange(0.0, 8.5, 0.5)
curve = eq.critical_speed(section, polar, incidence_deg=angles, speed=(5.0, 80.0))
lowest = curve.critical_speed.idxmin().item()
print(f"lowest onset {curve.critical_speed.min().item():.1f} m/s at {lowest:.1f} deg")

speeds = np.linspace(10.0, 55.0, 91)
growth = eq.stability(section, polar, incidence_deg=2.5, speed=speeds)

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(7.1, 2.9), layout="constrained")
curve.critical_speed.plot(ax=left, color="black")
left.set(ylim=(0, None), title="Onset over incidence", xlabel="rigid incidence (deg)")
left.set_ylabel("critical speed (m/s)")
growth.growth_rate.plot(ax=right, color="black")
right.axhline(0.0, color="grey", linewidth=0.6)
right.axvline(onset.critical_speed.item(), color="grey", linewidth=0.6, linestyle="dashed")
right.set(title="Growth at 2.5 deg", xlabel="speed (m/s)", ylabel="growth rate (1/s)")
figure.savefig("critical-speed.png", dpi=150)
