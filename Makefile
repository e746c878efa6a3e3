# Every figure and table of the paper, from source.
#
#   make deps all     installs the packages, builds, computes and draws everything
#   make deps test    the same, then the tests
#   make list         every target with one line
#
# One name from scene to figure: data/scenes/NAME.toml -> src/NAME.cpp or studies/NAME.* -> data/generated/NAME.tsv ->
# figures/NAME.gp or .py -> figures/generated/NAME.svg. The names stand in data/tables.mk. A table that data/reference
# keeps is a long study, and is drawn from there. The printed version of Table 1 (D-09) stands in as-printed/.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.PRECIOUS: data/generated/%.tsv
.SECONDEXPANSION:
.DEFAULT_GOAL := all
export LC_ALL := C
export TZ := UTC
export OMP_WAIT_POLICY := passive
export PYTHONDONTWRITEBYTECODE := 1
PYTHON ?= /usr/bin/python3
READING ?= exchanged
$(if $(filter-out exchanged as-printed,$(READING)),$(error READING=$(READING): must be exchanged or as-printed))
include data/tables.mk

# `deps` installs the packages of the goals beside it, before anything is read; without it what is missing is named.
goals := $(or $(filter-out deps,$(MAKECMDGOALS)),all)
ifeq ($(filter n q,$(foreach flag,n q,$(findstring $(flag),$(firstword -$(MAKEFLAGS))))),)
$(if $(shell paper/packages.sh $(if $(filter deps,$(MAKECMDGOALS)),install,check) $(goals) >&2 || echo no),$(error packages are missing))
# What killed makes have left behind: temporaries with the number of a process that is gone.
$(shell for one in $(wildcard $(addsuffix /*.[0-9]*.tmp,build data/generated data/generated/as-printed figures/generated figures/generated/as-printed)); do \
  pid=$${one%.tmp}; kill -0 "$${pid##*.}" 2> /dev/null || rm -f "$$one"; done)
endif
MAKEFLAGS += --no-builtin-rules

table = $(1:%=data/generated/%.tsv) $(2:%=data/generated/as-printed/%.tsv)
figure = $(1:%=figures/generated/%.svg) $(2:%=figures/generated/as-printed/%.svg)
claims := data/generated/claims.tsv data/generated/as-printed/claims.tsv
timings := $(call table,tab02_timing,tab02_timing)
texts := $(patsubst %,data/generated/%.md,deviations cage map_scaling manual)
untimed := $(filter-out $(timings),$(call table,$(paper) $(beside) sensitivity_derivatives truth_intervals,$(paper) truth_intervals) \
  $(call figure,$(drawn) $(drawn_beside),$(drawn))) $(texts)
shown := $(if $(filter exchanged,$(READING)),$(call table,$(paper) truth_intervals) data/generated/deviations.md $(call figure,$(drawn)), \
  $(call table,,$(paper) truth_intervals) $(call figure,,$(drawn)))
pages := build/book/.built build/paper/article.html
with_pages := $(filter all book article pdf test test-all sanitize readme dist,$(goals))
.PHONY: deps all figures timing claims studies truth maps $(studies) $(costs) adopt peers book article pdf png readme golden \
  live test sanitize bench format dist list clean

all: $(untimed) $(timings) $(claims) $(pages)  ## figures, tables and claims of both readings, pages, article
deps:  ## install the Debian packages that the goals beside it need
	@:
figures: $(shown)  ## the paper's figures and tables, of one READING (exchanged or as-printed)
claims: $(claims)  ## the verdict on each claim, for both readings
	$(PYTHON) figures/claims.py --print $(claims)

# Programs. CMake knows what each one needs; one make at a time builds, and the next waits for what outlives a killed one.
sources := $(shell find src data/bearings -type f) $(wildcard studies/*.cpp studies/*/*.?pp) CMakeLists.txt CMakePresets.json
build/.built: $(sources)
	@mkdir -p build; [ "$$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' build/CMakeCache.txt 2> /dev/null)" -ef . ] || \
	  rm -rf build/CMakeCache.txt build/CMakeFiles
	@touch $@.begun  # what is edited meanwhile is newer
	flock build/.lock cmake --preset release > build/configure.log
	flock build/.lock cmake --build --preset release
	@mv $@.begun $@
$(patsubst %.cpp,build/%,$(notdir $(wildcard src/*.cpp studies/*.cpp))): build/.built
	+@:
build/environment.txt: paper/environment.py build/.built
	$(whole) $(PYTHON) $< > $$new; mv $$new $@

# Tables. The stem is NAME or as-printed/NAME; what $$ begins is looked up when it is known. What is written is moved into
# place when it is complete. `parameters`: the machines that a scene names.
whole = @echo $@; mkdir -p $(@D); new=$@.$$BASHPID.tmp; trap 'rm -f $$new' EXIT;
reader := figures/tables.py figures/project.py CMakeLists.txt data/claims.toml
parameters = $(patsubst %,data/%$(if $(filter as-printed,$(*D)),-as-printed).toml, \
  $(shell sed -nE '/parameters = /s/[^"]*"([^"]*)"[^"]*/\1 /gp' data/scenes/$(*F).toml))

$(call table,$(maps)): data/generated/%.tsv: studies/%.yaml $$(wildcard studies/$$*.py) studies/Snakefile data/set1.toml build/explore figures/tables.py
	flock build/.snakemake snakemake --snakefile studies/Snakefile --profile studies/local $@
$(call table,$(scripts),$(scripts)): data/generated/%.tsv: studies/$$(*F).py data/scenes/$$(*F).toml $$(parameters) build/explore \
  figures/tables.py figures/rotor_stator/__init__.py
	$(whole) $(alone) $(PYTHON) $(wordlist 1,2,$^) $(filter as-printed,$(*D)) > $$new; mv $$new $@
data/generated/%.tsv: build/$$(*F) data/scenes/$$(*F).toml $$(parameters)
	$(whole) $(alone) $< $(word 2,$^) $(if $(filter as-printed,$(*D)),--reading as-printed) > $$new; mv $$new $@
data/generated/sensitivity_derivatives.tsv: figures/sensitivity_derivatives.py data/reference/sensitivity.tsv $(reader)
	$(whole) $(PYTHON) $(wordlist 1,2,$^) > $$new; mv $$new $@
data/generated/identification.tsv: build/regimes data/claims.toml data/set1-as-printed.toml data/set2-as-printed.toml

# Timings run alone: after all that is not timed, one after the other.
$(timings) $(call table,$(costs)): private alone = flock build/.timing
$(timings): | $(if $(with_pages)$(filter claims,$(goals)),$(untimed))
$(call table,$(costs)): | $(if $(filter studies,$(goals)),$(studies))

# Figures, from the kept table if there is one.
source = $(or $(wildcard data/reference/$(subst sections,attractors,$(subst truncation,validity,$*)).tsv),data/generated/$*.tsv)
figures/generated/%.svg: figures/$$(*F).gp figures/style.gp figures/orbit_axes.gp figures/orbits.gp figures/displacements.gp figures/tables.py $$(source)
	$(whole) gnuplot -e "table='$(source)'; output='$$new'" $<; mv $$new $@
figures/generated/%.svg: figures/$$(*F).py figures/rotor_stator.mplstyle figures/tables.py figures/bearing_sketch.py figures/contact_map.py \
  data/claims.toml $$(source)
	$(whole) $(PYTHON) $< $(source) $$new; mv $$new $@
figures/generated/identification.svg: figures/claim_quantities.py figures/claim_ranges.py data/scenes/fig07_contact.toml data/scenes/fig09_contact.toml
$(call figure,identification clearance_stiffness): data/set1.toml data/set2.toml data/set1-as-printed.toml
$(call figure,$(maps)): figures/map.py data/set1.toml
figures/generated/stability.svg: data/reference/attractors.tsv
$(call figure,work_precision peers): data/reference/peers.tsv data/reference/peers_auto.tsv data/generated/fig03_response.tsv
png: $(patsubst %.svg,%.png,$(call figure,$(drawn) $(drawn_beside),$(drawn)))  ## the figures as PNG, for viewing
%.png: %.svg
	$(whole) rsvg-convert --zoom 1.5 --background-color white --output $$new $<; mv $$new $@

# What follows from tables: intervals, claims, texts, pages. The stem is generated or generated/as-printed.
kept = $$(subst generated,reference,data/$$*/$(1).tsv)
data/generated/truth_intervals.tsv data/generated/as-printed/truth_intervals.tsv: data/%/truth_intervals.tsv: figures/truth_intervals.py \
  $(call kept,attractors) $(call kept,validity) $(reader)
	$(whole) $(PYTHON) $(wordlist 1,3,$^) > $$new; mv $$new $@
judging := figures/claim_quantities.py figures/claim_ranges.py figures/claim_score.py data/scenes/fig07_contact.toml data/scenes/fig09_contact.toml
$(claims): data/%/claims.tsv: figures/claims.py $(judging) $(reader) $(patsubst %,data/reference/%.tsv,clearance_stiffness identification \
  tab02_equal_error large) $(call kept,validity) $(patsubst %,data/\%/%.tsv,tab01_parameters fig03_response fig07_contact fig09_contact \
  regimes tab02_timing) | $(timings)
	$(whole) $(PYTHON) $< $(@D) $$new; mv $$new $@
live: build/live/index.html  ## the solver as a page for the browser, one file: build/live/index.html
include paper/paper.mk live/live.mk peers/peers.mk tests/tests.mk

# Long studies, computed anew and compared with the tables kept in data/reference.
studies: $(studies) $(costs) timing  ## the long studies, the maps and all timings (two and a half hours)
maps: $(call figure,clearance_speed stiffness_border)  ## two maps that nobody has published, drawn from their kept tables
truth: attractors validity stability verdicts adaptive  ## where the periodic solution is true (20 minutes)
timing: $(timings) $(call table,$(costs))  ## the tables of cost, alone on the machine (10 minutes)
$(studies) $(costs): $$(subst reference,generated,$$(wildcard data/reference/$$@.tsv data/reference/as-printed/$$@.tsv))
	$(PYTHON) tests/compare_kept.py $^
adopt:  ## keep the studies' tables and the verdicts of data/generated, also of NAME=new_study; a commit that does says why
	@for name in $(studies) $(costs) $(peers) claims $(NAME); do for folder in . as-printed; do new=data/generated/$$folder/$$name.tsv; \
	  if [ -e $$new ]; then mkdir -p data/reference/$$folder; cp -v $$new data/reference/$$folder/; fi; done; done

# Checks and the rest.
readme: all  ## refresh the README's pictures and its generated block
	$(PYTHON) figures/readme.py --write
format:  ## clang-format on all C++ sources
	clang-format-14 -i $$(find src studies tests peers -name '*.?pp')
list:  ## this list, and how old the kept tables are
	@sed -nE 's/^([a-z_-]+):.*##  ?(.*)/\1\t\2/p' $(MAKEFILE_LIST) | sort | column -t -s "$$(printf '\t')"
	@echo "One study: make NAME, of $(studies) $(costs)"
	@$(PYTHON) paper/ages.py | column -t -s "$$(printf '\t')"
clean:  ## remove everything that was built, computed or drawn
	rm -rf build build-debug data/generated figures/generated
