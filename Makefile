# `make run` and `make test` are all that is needed on a fresh clone; the snakemake commands
# behind them stand in the README.

PYTHON ?= python3
CORES ?= all
CONFIG ?=
FROM ?= kept
ENV := .venv
BIN := $(ENV)/bin
SNAKEMAKE := $(BIN)/snakemake --cores $(CORES) --workflow-profile workflow/profiles/default \
	$(if $(CONFIG),--configfile $(CONFIG))

# What `make paper` draws: kept results alone, or with FROM=scratch what is computed.
PAPER_FROM_kept := compute=false
PAPER_FROM_scratch := compute=true reuse='""'
# How many of its parts run side by side; CFD takes all cores.
PAPER_PARTS_kept := 3
PAPER_PARTS_scratch := 1
PAPER_PLATE := results/paper-plate-figures
PAPER_REDUCTIONS := results/paper-reductions
ifeq ($(PAPER_FROM_$(FROM)),)
$(error FROM is '$(FROM)'; allowed are kept and scratch)
endif

.PHONY: run install report paper paper-plate paper-figures paper-reductions paper-meshes validation cost identification cost-model status verify test lint docs drawing gallery pictures bench openfoam slurm chromium clean

run: $(ENV)/run
	@folder=$$($(BIN)/equisection folder $(CONFIG)) && echo "$(SNAKEMAKE)" && $(SNAKEMAKE) && printf '%s\n' '' \
		"figures:    $$folder/figures/" \
		"tables:     $$folder/tables/ and $$folder/comparison/" \
		"report:     make report$(if $(CONFIG), CONFIG=$(CONFIG)) writes $$folder/report.html" \
		"each run:   $(BIN)/equisection status $$folder"

install: $(ENV)/run
	@echo "installed in $(ENV): source $(BIN)/activate"

report: $(ENV)/report
	@folder=$$($(BIN)/equisection folder $(CONFIG)) && $(SNAKEMAKE) -- report_page && \
		echo "report: $$folder/report.html"

paper: $(ENV)/run
	@$(MAKE) --no-print-directory -j $(PAPER_PARTS_$(FROM)) paper-figures paper-reductions paper-meshes
	$(BIN)/python -m equisection.paper.claims_page
	cp results/paper-figures/figures/fig16-response.png results/paper-figures/figures/growth-rate.png \
		$(PAPER_REDUCTIONS)/figures/section-and-beam.png docs/
	@printf '%s\n' '' "figures:    results/paper-figures/figures/, Figs. 9 to 12 in $(PAPER_PLATE)/figures/" \
		"tables:     results/paper-figures/tables/ and comparison/, Table 1 in $(PAPER_PLATE)/tables/" \
		"reductions: $(PAPER_REDUCTIONS)/figures/section-and-beam.png"

# Parts of `make paper`, side by side where they do not take what another makes: each has spells in
# which it takes one core. Of two Snakemakes side by side one has no lock: with two the first to end
# removes the folder of locks, in which the other may just write its own.
paper-plate:
	$(SNAKEMAKE) --configfile config/openfoam3d.yaml config/paper/plate.yaml --config $(PAPER_FROM_$(FROM)) \
		-- $(PAPER_PLATE)/unsteady/3d/sweep.json $(PAPER_PLATE)/tables/table1.csv \
		$(PAPER_PLATE)/figures/fig09-plate-mesh.png $(PAPER_PLATE)/figures/fig10-spanwise-loads.png \
		$(PAPER_PLATE)/figures/fig11-plate-surface.png $(PAPER_PLATE)/figures/fig12-tip-flow.png

paper-figures: paper-plate
	$(SNAKEMAKE) --configfile config/openfoam.yaml config/paper/figures.yaml --config $(PAPER_FROM_$(FROM))

paper-reductions: paper-plate
	$(SNAKEMAKE) --nolock --configfile config/openfoam3d.yaml config/paper/reductions.yaml --config $(PAPER_FROM_$(FROM)) \
		-- $(PAPER_REDUCTIONS)/figures/section-and-beam.png
	$(SNAKEMAKE) --nolock --configfile config/openfoam3d.yaml config/paper/reductions.yaml config/paper/reductions-modal.yaml \
		--config $(PAPER_FROM_$(FROM)) -- $(PAPER_REDUCTIONS)-modal/figures/section-and-beam.png

paper-meshes:
	$(BIN)/python -m equisection.paper.mesh_convergence

validation: $(ENV)/run
	$(BIN)/python -m equisection.validation

cost: $(ENV)/run
	$(SNAKEMAKE) --configfile config/paper/embedded.yaml -- results/paper-embedded/comparison/summary.csv
	cp results/paper-embedded/comparison/summary.csv results/reference/embedded-cost.csv

identification: $(ENV)/run
	$(SNAKEMAKE) -- identification
	@folder=$$($(BIN)/equisection folder $(CONFIG)) && cat $$folder/identification/lags.yaml

cost-model: $(ENV)/run
	$(BIN)/equisection cost-model results --write workflow/profiles/cost.yaml

status: $(ENV)/run
	$(BIN)/equisection status
	@echo "as a page: $(BIN)/equisection status --html status.html"

verify: $(ENV)/run
	$(BIN)/equisection verify

# Three parts side by side: tests that run OpenFOAM or SLURM, the first half of those that start Snakemake, and
# the others, which are seen while they run.
FIRST_HALF := tests/workflow/test_[a-o]*.py
test: $(ENV)/test
	@logs=$$(mktemp -d); ids=; trap 'kill $$ids; rm -r $$logs; exit 130' INT TERM; \
		$(BIN)/python -m pytest -p no:cacheprovider tests/openfoam tests/slurm >$$logs/openfoam 2>&1 & ids="$$ids $$!"; \
		$(BIN)/python -m pytest -p no:cacheprovider $(FIRST_HALF) >$$logs/workflow 2>&1 & ids="$$ids $$!"; \
		$(BIN)/python -m pytest --ignore=tests/openfoam --ignore=tests/slurm \
			--ignore-glob='$(FIRST_HALF)'; failed=$$?; \
		for id in $$ids; do wait $$id || failed=1; done; \
		for part in openfoam workflow; do echo "$$part, which ran beside:"; cat $$logs/$$part; done; \
		rm -r $$logs; exit $$failed

lint: $(ENV)/lint
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	$(BIN)/mypy --disable-error-code name-defined scripts
	$(BIN)/mypy docs/drawings/*.py
	$(BIN)/python -m equisection.config --check
	$(BIN)/python -m equisection.figures --check
	$(BIN)/snakemake --lint

docs: $(ENV)/docs
	$(BIN)/python -m sphinx --quiet --fail-on-warning --keep-going --nitpicky \
		--conf-dir docs --doctree-dir .sphinx . site
	cp docs/_static/to-the-landing-page.html site/index.html
	@echo "site: site/index.html"

drawing: $(ENV)/run
	$(BIN)/python docs/drawings/beam_and_section.py docs/beam-and-section.svg
	$(BIN)/python docs/drawings/examples.py docs/gallery

# Pictures of the gallery: configuration, figure and place in docs/ of each.
GALLERY := tracker_over_tilt,tracker-over-tilt/figures/critical-speed,gallery/tracker \
	bridge_deck,bridge-deck/figures/growth-rate,gallery/bridge \
	goland_wing,goland-wing/figures/growth-rate,gallery/wing \
	plate_over_incidence,plate-over-incidence/figures/critical-speed,critical-speed-over-incidence
gallery: drawing
	@for words in $(GALLERY); do set -- $$(echo $$words | tr , ' '); \
		$(SNAKEMAKE) --configfile config/examples/$$1.yaml -- results/$$2.png && \
		cp results/$$2.png docs/$$3.png || exit 1; \
	done

# Every other picture of the pages that a run draws; those of the paper are drawn by `make paper`.
PICTURES := $(SNAKEMAKE) --configfile
pictures: $(ENV)/openfoam gallery # outlines need gmsh, also where their results are kept
	$(PICTURES) config/examples/plate_over_incidence.yaml -- results/plate-over-incidence/figures/modes-over-speed.png
	$(PICTURES) config/examples/openfoam_deck.yaml --config compute=false \
		-- results/openfoam-deck/figures/response.png results/openfoam-deck/figures/mesh-of-section.png
	$(PICTURES) config/examples/openfoam_tracker.yaml --config compute=false \
		-- results/openfoam-tracker/figures/response.png results/openfoam-tracker/figures/mesh-of-section.png
	$(PICTURES) config/examples/openfoam_h_section.yaml --config compute=false \
		-- results/openfoam-h-section/figures/response.png
	$(PICTURES) config/examples/thin_plate_forced.yaml -- results/thin-plate-forced/figures/flutter-derivatives.png
	$(BIN)/python docs/examples/other_program.py data/other-program
	$(PICTURES) docs/examples/other_program.yaml -- results/other-program/figures/growth-rate.png
	$(SNAKEMAKE) --config run=forced-modes 'forced={run: true, beam_modes: 2, incidence_deg: 3.01}' \
		-- results/forced-modes/figures/flutter-derivatives.png results/forced-modes/figures/forces-on-modes.png
	$(BIN)/python docs/examples/critical_speed.py && mv critical-speed.png docs/
	cp results/plate-over-incidence/figures/modes-over-speed.png docs/
	cp results/openfoam-deck/figures/response.png docs/deck-response.png
	cp results/openfoam-deck/figures/mesh-of-section.png docs/deck-mesh.png
	cp results/openfoam-tracker/figures/response.png docs/tracker-response.png
	cp results/openfoam-tracker/figures/mesh-of-section.png docs/tracker-mesh.png
	cp results/openfoam-h-section/figures/response.png docs/h-section-response.png
	cp results/thin-plate-forced/figures/flutter-derivatives.png docs/thin-plate-derivatives.png
	cp results/other-program/figures/growth-rate.png docs/given-growth-rate.png
	cp results/forced-modes/figures/flutter-derivatives.png results/forced-modes/figures/forces-on-modes.png docs/

bench: $(ENV)/test
	$(BIN)/python -m tests.benchmarks

# Debian and Ubuntu have it packaged; as root, or with sudo. Elsewhere see docs/openfoam.md. gmsh, which
# meshes outlines, comes from Python's packages and needs libraries of the system.
GMSH_NEEDS := libglu1-mesa libxcursor1 libxft2 libxinerama1 libxrender1 libfontconfig1 libgomp1
openfoam: $(ENV)/openfoam
	@command -v simpleFoam >/dev/null && $(BIN)/python -c 'import gmsh' 2>/dev/null && \
		{ echo "OpenFOAM is there: $$(command -v simpleFoam)"; exit 0; }; \
	command -v apt-get >/dev/null || \
		{ echo "error: no apt-get here; docs/openfoam.md says how else to install OpenFOAM" >&2; exit 1; }; \
	as_root=$$([ $$(id -u) -eq 0 ] || echo sudo); \
	$$as_root apt-get update --quiet && $$as_root apt-get install --quiet --yes openfoam $(GMSH_NEEDS)

# A scheduler of one machine, for the tests; Debian and Ubuntu, as root or with sudo. Snakemake's part
# has a folder of its own, since it would cost every start of Snakemake some time.
slurm: $(ENV)/slurm/installed
	@command -v slurmctld >/dev/null && command -v munged >/dev/null && { echo "SLURM is there: $$(slurmctld -V)"; exit 0; }; \
	command -v apt-get >/dev/null || \
		{ echo "error: no apt-get here; install slurmctld, slurmd and munged by hand" >&2; exit 1; }; \
	as_root=$$([ $$(id -u) -eq 0 ] || echo sudo); \
	$$as_root apt-get update --quiet && $$as_root apt-get install --quiet --yes slurm-wlm munge libpmix-dev

# A browser, in which the tests look at the report; Debian and Ubuntu, as root or with sudo.
chromium:
	@for name in chromium chromium-browser google-chrome; do \
		command -v $$name >/dev/null && { echo "Chromium is there: $$(command -v $$name)"; exit 0; }; \
	done; \
	command -v apt-get >/dev/null || \
		{ echo "error: no apt-get here; install Chromium by hand" >&2; exit 1; }; \
	as_root=$$([ $$(id -u) -eq 0 ] || echo sudo); \
	$$as_root apt-get update --quiet && $$as_root apt-get install --quiet --yes chromium

clean:
	find results -mindepth 1 -maxdepth 1 ! -name reference -exec rm -rf {} +
	rm -rf .snakemake .sphinx site

# One environment; each stamp says which extras are in it, and is renewed when the pins change.
$(ENV)/python-is-new-enough:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "error: $(PYTHON) is $$($(PYTHON) -V 2>&1); Python 3.11 or newer is needed (make PYTHON=python3.12 ...)" >&2; exit 1; }
	$(PYTHON) -m venv $(ENV)
	@touch $@

$(ENV)/run: $(ENV)/python-is-new-enough envs/constraints.txt pyproject.toml
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable .
	@touch $@

$(ENV)/report: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable '.[report]'
	@touch $@

$(ENV)/openfoam: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable '.[openfoam]'
	@touch $@

$(ENV)/test: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable '.[test,openfoam,report]'
	@touch $@

$(ENV)/docs: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable '.[docs]'
	@touch $@

$(ENV)/slurm/installed: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --no-deps --upgrade \
		--target $(ENV)/slurm snakemake-executor-plugin-slurm snakemake-executor-plugin-slurm-jobstep
	@touch $@

$(ENV)/lint: $(ENV)/run
	$(BIN)/python -m pip install --quiet --constraint envs/constraints.txt --editable '.[lint]'
	@touch $@
