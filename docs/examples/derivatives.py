"""Onset of a bridge deck from its flutter derivatives, measured or computed."""

# %%
import math

import equisection as eq

heave, pitch, damping = math.tau * 0.1, math.tau * 0.278, 0.003
deck = eq.Section(
    mass=22740.0,
    inertia=2.47e6,
    flexural_stiffness=22740.0 * heave**2,
    torsional_stiffness=2.47e6 * pitch**2,
    flexural_damping=2 * damping * 22740.0 * heave,
    torsional_damping=2 * damping * 2.47e6 * pitch,
    chord=31.0,
)
derivatives = eq.Derivatives.read("config/derivatives/thin_plate.csv")

# %% The onset, with the interval that the rows of the table leave
onset = eq.critical_speed(deck, derivatives, speed=(20.0, 120.0), density=1.22)
print(
    f"{onset.mechanism.item()} at {onset.critical_speed:.2f} m/s, between {onset.speed_low:.2f} "
    f"and {onset.speed_high:.2f}, with {onset.frequency:.4f} Hz"
)

# %% Growth over speed
motion = eq.stability(deck, derivatives, speed=[60.0, 75.0, 80.0], density=1.22)
for speed in motion.speed.values:
    at = motion.sel(speed=speed)
    print(f"{speed:.0f} m/s: growth {at.growth_rate:+.4f} 1/s at {at.frequency:.4f} Hz")
