# Every figure and table of the paper, from source.
#
#   make deps all     installs the packages, builds, computes and draws everything
#   make deps test    the same, then the tests
#   make list         every target with one line
#
# Data flow, one way: parameters and scenes (data/) -> programs (build/) -> tables (data/generated/)
# -> figures (figures/generated/). A target is written under another name and moved into place when
# it is complete, so a killed make leaves nothing half done behind a final name.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
export LC_ALL := C
export TZ := UTC
export PYTHONDONTWRITEBYTECODE := 1

PYTHON ?= /usr/bin/python3

# `figures` draws one reading of Table 1's frequencies (deviation D-09), `all` both.
READING ?= exchanged
ifeq ($(filter $(READING),exchanged as-printed),)
$(error READING=$(READING): must be exchanged or as-printed)
endif

comma := ,

# Where the tables and figures of a reading go, and which parameter files it takes.
folder_exchanged :=
folder_as-printed := /as-printed
suffix_exchanged :=
suffix_as-printed := -as-printed

figure_names := fig01_bearing fig02_ball_position fig03_response fig04_displacements fig05_displacements fig06_orbits fig07_contact fig08_orbits fig09_contact
table_names := $(figure_names) tab01_parameters regimes sections truth_intervals multipliers
drawn_names := $(figure_names) truncation sections validity

tables_of = $(table_names:%=data/generated$(folder_$(1))/%.tsv)
timing_of = data/generated$(folder_$(1))/tab02_timing.tsv
claims_of = data/generated$(folder_$(1))/claims.tsv
figures_of = $(drawn_names:%=figures/generated$(folder_$(1))/%.svg)
results_of = $(tables_of) $(timing_of) $(figures_of)

# What does not depend on the reading.
studied := $(addprefix data/generated/,sensitivity.tsv sensitivity_derivatives.tsv sampling.tsv) \
  $(addprefix figures/generated/,sensitivity.svg sampling.svg identification.svg clearance_stiffness.svg peers.svg adaptive.svg) \
  $(addprefix figures/generated/,work_precision.svg cost_growth.svg hard_cases.svg)

# The text whose numbers come from tables; the default reading's, since it compares both.
pages := data/generated/deviations.md

readings := exchanged as-printed
# Drawn for the readings whose table is kept.
studied += $(foreach reading,$(readings),$(if \
  $(wildcard data/reference$(folder_$(reading))/stability.tsv),figures/generated$(folder_$(reading))/stability.svg))
timings := $(foreach reading,$(readings),$(call timing_of,$(reading)))
claims := $(foreach reading,$(readings),$(call claims_of,$(reading)))
untimed := $(foreach reading,$(readings),$(call tables_of,$(reading)) $(call figures_of,$(reading))) \
  $(studied) $(pages)
programs := $(patsubst src/%.cpp,build/%,$(wildcard src/*.cpp))

book := build/book/index.html
article := build/paper/article.html

.PHONY: all figures timing claims book article pdf deps-pdf dist test sanitize deps list png readme golden format clean \
  studies identification clearance_stiffness hard truth attractors validity stability adaptive adopt peers deps-peers bench

all: $(untimed) $(timings) $(claims) $(book) $(article)  ## figures, tables and claims of both readings, pages and article (the default)

figures: $(call results_of,$(READING)) $(if $(filter exchanged,$(READING)),$(pages))  ## the paper's figures and tables, of one READING

# The programs of cost; their tables are kept, since their numbers are those of one machine.
costs := work_precision tab02_equal_error cost_growth

timing: $(call timing_of,$(READING)) $(costs:%=build/%)  ## all tables of cost, alone on the machine (under 10 minutes)
	@mkdir -p data/generated
	for name in $(costs); do new=data/generated/$$name.tsv; build/$$name > $$new.tmp; mv $$new.tmp $$new; \
	  $(PYTHON) tests/compare_costs.py data/reference/$$name.tsv $$new; done

claims: $(claims)  ## the verdict on each claim, for both readings
	$(PYTHON) figures/claims.py --print $(claims)

# ---------------------------------------------------------------------------------------------
# Packages

packages := cmake ninja-build g++ pkg-config libeigen3-dev libfftw3-dev libgsl-dev \
  libtomlplusplus-dev libcli11-dev catch2 gnuplot-nox python3-matplotlib librsvg2-bin git \
  libbenchmark-dev pandoc chromium chromium-driver python3-selenium python3-hypothesis tidy

# The packages of the list that dpkg does not have; nothing on systems without dpkg.
missing_packages = command -v dpkg-query > /dev/null || exit 0; \
  for package in $(packages); do \
    [ "$$(dpkg-query -W -f='$${db:Status-Status}' $$package 2> /dev/null)" = installed ] || \
      printf '%s ' $$package; \
  done

define require_packages
@missing="$$($(missing_packages))"; if [ -n "$$missing" ]; then \
  echo "missing: $$missing(make deps installs them)" >&2; exit 1; fi
endef

deps:  ## install the Debian packages; elsewhere, list what to install
	@if ! command -v apt-get > /dev/null; then \
	  echo "no apt-get here; install what these Debian packages hold: $(packages)"; exit 0; fi; \
	missing="$$($(missing_packages))"; \
	if [ -z "$$missing" ]; then exit 0; fi; \
	sudo=; if [ "$$(id -u)" != 0 ] && command -v sudo > /dev/null; then sudo=sudo; fi; \
	$$sudo apt-get update && \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $$missing

# What only `pdf` needs.
packages_pdf := texlive-luatex texlive-latex-recommended texlive-fonts-recommended lmodern

deps-pdf:  ## install the LaTeX packages of the PDF
	$(MAKE) deps packages="$(packages_pdf)"

# What only `peers` needs.
packages_peers := libsundials-dev python3-scipy auto-07p gfortran

deps-peers:
	$(MAKE) deps packages="$(packages_peers)"

# When deps is asked for, everything else waits for it, with -j too.
build/.built $(untimed): | $(filter deps,$(MAKECMDGOALS))

# ---------------------------------------------------------------------------------------------
# Programs. CMake knows what each one needs: build/.built only says that it had nothing left to do,
# and a program that it did not touch keeps its date. The lock waits for a build that outlived a
# killed make.

sources := $(shell find src tests -type f -not -name '*.tsv') CMakeLists.txt CMakePresets.json

build/.built: $(sources)
	$(require_packages)
	@mkdir -p build
	flock build/.lock bash -euc 'cmake --preset release > build/configure.log && \
	  cmake --build --preset release && touch $@'

# A program older than build/.built was not touched. The + runs this nothing under make -q too, which
# then looks at the program's real date.
$(programs): build/.built
	+@:

# ---------------------------------------------------------------------------------------------
# Tables: $(call table,name,program,data sets[,scene, if it has another name])

# Writes the target under another name and moves it into place when the command has ended well.
# $(call whole,command), where the command writes to "$$new".
define whole
@rm -f $@.*.tmp
new=$@.$$$$.tmp; trap 'rm -f $$new' EXIT; $(1); mv $$new $@
endef

# $(call table_of,name,program,data sets,scene,reading)
define table_of
data/generated$(folder_$(5))/$(1).tsv: build/$(2) data/scenes/$(4).toml $(3:%=data/%$(suffix_$(5)).toml)
	@mkdir -p $$(@D)
	$$(call whole,$$< data/scenes/$(4).toml --reading $(5) > $$$$new)
endef

define table
$(foreach reading,$(readings),$(eval $(call table_of,$(1),$(2),$(3),$(or $(4),$(1)),$(reading))))
endef

$(eval $(call table,fig01_bearing,fig01_bearing,set1))
$(eval $(call table,fig02_ball_position,fig02_ball_position,set1))
$(eval $(call table,fig03_response,fig03_response,set1 set2))
$(eval $(call table,fig04_displacements,fig04_displacements,set1))
$(eval $(call table,fig05_displacements,fig05_displacements,set1))
$(eval $(call table,fig06_orbits,fig06_orbits,set1))
$(eval $(call table,fig07_contact,fig07_contact,set1))
$(eval $(call table,fig08_orbits,fig08_orbits,set2))
$(eval $(call table,fig09_contact,fig09_contact,set2))
$(eval $(call table,tab01_parameters,tab01_parameters,set1 set2))
$(eval $(call table,tab02_timing,tab02_timing,set1))
$(eval $(call table,regimes,regimes,set1 set2))
$(eval $(call table,multipliers,multipliers,set1 set2))
$(eval $(call table,sensitivity,sensitivity,set1))
$(eval $(call table,sensitivity_derivatives,sensitivity_derivatives,set1,sensitivity))

$(eval $(call table,sampling,sampling,set1 set2))

$(eval $(call table_of,deviations,deviations,set1 set1-as-printed,deviations,exchanged))

# Timings run alone: after all that is not timed, one after the other.
$(foreach reading,$(readings),$(eval $(call timing_of,$(reading)): | \
  $(call tables_of,$(reading)) $(call figures_of,$(reading))))
ifneq ($(filter all test sanitize claims,$(or $(MAKECMDGOALS),all)),)
$(timings): | $(untimed)
$(call timing_of,as-printed): | $(call timing_of,exchanged)
endif

# ---------------------------------------------------------------------------------------------
# Figures: $(call curves,name,script,what it loads) with gnuplot, $(call map,…) with Matplotlib

# $(call curves_of,name,script,what it loads,reading), $(call map_of,…)
define curves_of
figures/generated$(folder_$(4))/$(1).svg: figures/$(2).gp figures/style.gp $(3) data/generated$(folder_$(4))/$(1).tsv
	@mkdir -p $$(@D)
	$$(call whole,gnuplot -e "table='data/generated$(folder_$(4))/$(1).tsv'; output='$$$$new'" $$<)
endef

define map_of
figures/generated$(folder_$(4))/$(1).svg: figures/$(2).py figures/rotor_stator.mplstyle figures/tables.py $(3) data/generated$(folder_$(4))/$(1).tsv
	@mkdir -p $$(@D)
	$$(call whole,$$(PYTHON) $$< data/generated$(folder_$(4))/$(1).tsv $$$$new)
endef

curves = $(foreach reading,$(readings),$(eval $(call curves_of,$(1),$(2),$(3),$(reading))))
map = $(foreach reading,$(readings),$(eval $(call map_of,$(1),$(2),$(3),$(reading))))

$(eval $(call map,fig01_bearing,fig01_bearing,figures/bearing_sketch.py))
$(eval $(call map,fig02_ball_position,fig02_ball_position,figures/bearing_sketch.py))
$(eval $(call curves,fig03_response,fig03_response,))
$(eval $(call curves,fig04_displacements,fig04_displacements,figures/displacements.gp figures/orbit_axes.gp))
$(eval $(call curves,fig05_displacements,fig05_displacements,figures/displacements.gp figures/orbit_axes.gp))
$(eval $(call curves,fig06_orbits,fig06_orbits,figures/orbits.gp figures/orbit_axes.gp))
$(eval $(call map,fig07_contact,fig07_contact,figures/contact_map.py))
$(eval $(call curves,fig08_orbits,fig08_orbits,figures/orbits.gp figures/orbit_axes.gp))
$(eval $(call map,fig09_contact,fig09_contact,figures/contact_map.py))
$(eval $(call curves,sensitivity,sensitivity,))
$(eval $(call curves,sampling,sampling,))

# The long studies are drawn from their kept tables.
figures/generated/identification.svg figures/generated/clearance_stiffness.svg figures/generated/hard_cases.svg: \
  figures/generated/%.svg: \
  figures/%.py figures/rotor_stator.mplstyle figures/tables.py data/claims.toml \
  data/set1.toml data/set2.toml data/reference/%.tsv
	@mkdir -p $(@D)
	$(call whole,$(PYTHON) $< data/reference/$*.tsv $$new)

figures/generated/identification.svg: data/set1-as-printed.toml

figures/generated/peers.svg: figures/peers.py figures/rotor_stator.mplstyle figures/tables.py \
  data/reference/peers.tsv data/reference/peers_auto.tsv data/generated/fig03_response.tsv
	@mkdir -p $(@D)
	$(call whole,$(PYTHON) $< data/reference/peers.tsv $$new)

figures/generated/work_precision.svg figures/generated/cost_growth.svg: figures/generated/%.svg: \
  figures/%.py figures/rotor_stator.mplstyle figures/tables.py data/reference/%.tsv \
  $(wildcard data/reference/peers.tsv)
	@mkdir -p $(@D)
	$(call whole,$(PYTHON) $< data/reference/$*.tsv $$new)

# What is true is drawn from its kept tables too, of each reading; the sections are integrated anew from the
# states of the attractors. $(call truth_of,folder,suffix,reading)
define truth_of
data/generated$(1)/sections.tsv: build/sections data/scenes/sections.toml \
  data/set1$(2).toml data/set2$(2).toml data/reference$(1)/attractors.tsv
	@mkdir -p $$(@D)
	$$(call whole,$$< data/scenes/sections.toml --reading $(3) --attractors data/reference$(1)/attractors.tsv > $$$$new)

data/generated$(1)/truth_intervals.tsv: figures/truth_intervals.py figures/tables.py figures/project.py CMakeLists.txt data/claims.toml \
  data/reference$(1)/attractors.tsv data/reference$(1)/validity.tsv
	@mkdir -p $$(@D)
	$$(call whole,$$(PYTHON) $$< data/reference$(1)/attractors.tsv data/reference$(1)/validity.tsv > $$$$new)

figures/generated$(1)/truncation.svg: figures/truncation.gp figures/style.gp data/claims.toml data/reference$(1)/validity.tsv
	@mkdir -p $$(@D)
	$$(call whole,gnuplot -e "table='data/reference$(1)/validity.tsv'; output='$$$$new'" $$<)

figures/generated$(1)/validity.svg: figures/validity.py figures/rotor_stator.mplstyle figures/tables.py data/claims.toml \
  data/reference$(1)/validity.tsv
	@mkdir -p $$(@D)
	$$(call whole,$$(PYTHON) $$< data/reference$(1)/validity.tsv $$$$new)

figures/generated$(1)/sections.svg: figures/sections.py figures/rotor_stator.mplstyle figures/tables.py \
  data/generated$(1)/sections.tsv
	@mkdir -p $$(@D)
	$$(call whole,$$(PYTHON) $$< data/generated$(1)/sections.tsv $$$$new)
endef

$(foreach reading,$(readings),$(eval $(call truth_of,$(folder_$(reading)),$(suffix_$(reading)),$(reading))))

# So is the stability of the response curves.
define stability_of
figures/generated$(folder_$(1))/stability.svg: figures/stability.gp figures/style.gp \
  data/reference$(folder_$(1))/stability.tsv data/reference$(folder_$(1))/attractors.tsv
	@mkdir -p $$(@D)
	$$(call whole,gnuplot -e "table='data/reference$(folder_$(1))/stability.tsv'; \
	  attractors='data/reference$(folder_$(1))/attractors.tsv'; output='$$$$new'" $$<)
endef

$(foreach reading,$(readings),$(eval $(call stability_of,$(reading))))

figures/generated/adaptive.svg: figures/adaptive.py figures/rotor_stator.mplstyle figures/tables.py \
  data/reference/adaptive.tsv
	@mkdir -p $(@D)
	$(call whole,$(PYTHON) $< data/reference/adaptive.tsv $$new)

png: $(patsubst %.svg,%.png,$(filter %.svg,$(untimed)))  ## the figures as PNG, for viewing

%.png: %.svg
	$(call whole,rsvg-convert --zoom 1.5 --background-color white --output $$new $<)

# ---------------------------------------------------------------------------------------------
# Pages: text of paper/ with the numbers of a table of the same name

$(pages): data/generated/%.md: paper/include.py paper/%.md data/generated/%.tsv
	$(call whole,$(PYTHON) $^ > $$new)

# The sources as pages, with their figures and tables. A folder is complete when it has its index: it
# is made under another name and moved into place.
kept := $(wildcard data/reference/*.tsv)

book: $(book)  ## the sources as pages, in reading order: build/book/index.html

$(book): $(wildcard paper/book/*) paper/guide.md paper/references.bib $(shell find src -type f) \
  $(untimed) $(timings) $(claims) $(kept)
	rm -rf build/book build/book.new
	$(PYTHON) paper/book/weave.py build/book.new
	mv build/book.new build/book

article: $(article)  ## the article: build/paper/article.html

data/generated/article.tsv: paper/article_values.py paper/article_results.py figures/tables.py figures/project.py \
  data/claims.toml data/scenes/validity.toml data/set1.toml data/set1-as-printed.toml paper/deviations.md $(untimed) $(timings) $(claims) $(kept)
	$(call whole,$(PYTHON) $< > $$new)

data/generated/article.md: paper/include.py paper/article.md data/generated/article.tsv
	$(call whole,$(PYTHON) $^ > $$new)

$(article): data/generated/article.md paper/render_article.py paper/article.html \
  paper/book/comments.py paper/book/book.css paper/book/figures.toml paper/references.bib
	@mkdir -p $(@D)
	$(PYTHON) paper/render_article.py $< $@

pdf: build/paper/article.pdf  ## the article as PDF (its packages: make deps-pdf)

build/paper/article.pdf: data/generated/article.md paper/render_article.py paper/article.tex \
  paper/book/comments.py paper/references.bib
	@mkdir -p $(@D)
	$(PYTHON) paper/render_article.py $< $@

# ---------------------------------------------------------------------------------------------
# Claims: $(call claims_rule,reading)

define claims_rule
$(claims_of): figures/claims.py figures/tables.py figures/project.py data/claims.toml data/reference/clearance_stiffness.tsv \
  data/reference$(folder_$(1))/validity.tsv \
  $(tables_of) $(timing_of)
	$$(call whole,$$(PYTHON) figures/claims.py $$(@D) $$$$new)
endef

$(foreach reading,$(readings),$(eval $(call claims_rule,$(reading))))

# ---------------------------------------------------------------------------------------------
# Long studies. Finished pieces are kept in a journal, so an interrupted study goes on; the tables are
# kept in data/reference, where `all` finds them, and compared with what is computed anew.

studies: identification clearance_stiffness hard truth timing  ## run the long studies and compare them with their kept tables

ifneq ($(filter studies,$(MAKECMDGOALS)),)
timing: | identification clearance_stiffness hard truth
endif

identification: build/identification  ## score the grid of unpublished parameters (under 10 minutes)
	@mkdir -p data/generated
	new=data/generated/identification.tsv; $< --journal data/generated/identification.journal > $$new.tmp; \
	  mv $$new.tmp $$new; $(PYTHON) tests/compare_tables.py data/reference/identification.tsv $$new

clearance_stiffness: build/clearance_stiffness  ## clearance against contact stiffness (under 5 minutes)
	@mkdir -p data/generated
	new=data/generated/clearance_stiffness.tsv; $< --journal data/generated/clearance_stiffness.journal > $$new.tmp; \
	  mv $$new.tmp $$new; $(PYTHON) tests/compare_tables.py data/reference/clearance_stiffness.tsv $$new

stability: build/stability  ## stability along the response curves, both readings (under 5 minutes)
	@mkdir -p data/generated
	for reading in exchanged as-printed; do suffix=; \
	  if [ $$reading = as-printed ]; then suffix=-as-printed; fi; \
	  new=data/generated/stability$$suffix.tsv; \
	  $< --reading $$reading --journal data/generated/stability$$suffix.journal > $$new.tmp; mv $$new.tmp $$new; \
	  if [ -e data/reference/stability$$suffix.tsv ]; then \
	    $(PYTHON) tests/compare_tables.py data/reference/stability$$suffix.tsv $$new; fi; done

adaptive: build/adaptive  ## estimate, true error and cost of adaptive harmonics (under 5 minutes)
	@mkdir -p data/generated
	new=data/generated/adaptive.tsv; $< --journal data/generated/adaptive.journal > $$new.tmp; \
	  mv $$new.tmp $$new; $(PYTHON) tests/compare_tables.py data/reference/adaptive.tsv $$new

hard: build/hard_cases  ## how each method ends on the hard cases (under 5 minutes)
	@mkdir -p data/generated
	new=data/generated/hard_cases.tsv; $< > $$new.tmp; \
	  mv $$new.tmp $$new; $(PYTHON) tests/compare_tables.py \
    --columns case,method,status,verdict,regime data/reference/hard_cases.tsv $$new

# Other people's programs on the same equations; not part of `studies`, and installed by this alone.
peers: build/explore | deps-peers  ## outside integrators and AUTO-07p, timed (under 10 minutes)
	@mkdir -p data/generated
	flock build/.lock bash -euc 'cmake -S peers --preset release > build/configure-peers.log && \
	  cmake --build build/peers'
	export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1; \
	$(PYTHON) peers/check.py data/scenes/peers.toml; \
	for table in peers.py:peers auto_curve.py:peers_auto; do \
	  new=data/generated/$${table#*:}.tsv; \
	  $(PYTHON) peers/$${table%:*} data/scenes/$${table#*:}.toml > $$new.tmp; mv $$new.tmp $$new; done

truth: attractors validity stability adaptive  ## where the periodic solution is true: attractors, validity map, stability

# $(call of_readings,name,shell words of a run with $$r and $$s for reading and suffix,how to compare)
define of_readings
@mkdir -p data/generated/as-printed
for r in $(readings); do s=-$$r; d=/$$r; if [ $$r = exchanged ]; then s=; d=; fi; \
  new=data/generated$$d/$(1).tsv; \
  build/$(1) data/scenes/$(1).toml --reading $$r --journal data/generated$$d/$(1).journal $(2) > $$new.tmp; \
  mv $$new.tmp $$new; $(PYTHON) tests/compare_tables.py $(3) data/reference/$(1)$$s.tsv $$new; done
endef

attractors: build/attractors  ## where time integration settles, speed by speed (under 6 minutes)
	$(call of_readings,attractors,,--key set$(comma)f$(comma)origin$(comma)verdict --columns set)

validity: build/validity attractors  ## distance of the solutions to the attractors (under 3 minutes)
	$(call of_readings,validity,--attractors data/generated$$d/attractors.tsv,--columns found$(comma)distance$(comma)periodic)

adopt:  ## keep the tables of the studies just run, and the verdicts; a commit that does says why
	@mkdir -p data/reference
	for name in identification study hard_cases adaptive stability stability-as-printed peers peers_auto $(costs); do \
	  if [ -e data/generated/$$name.tsv ]; then cp data/generated/$$name.tsv data/reference/; fi; done
	for name in attractors validity; do for s in "" -as-printed; do \
	  new=data/generated/$${s#-}/$$name.tsv; \
	  if [ -e $$new ]; then cp $$new data/reference/$$name$$s.tsv; fi; done; done
	cp data/generated/claims.tsv data/reference/claims.tsv
	cp data/generated/as-printed/claims.tsv data/reference/claims-as-printed.tsv

# ---------------------------------------------------------------------------------------------
# Checks and the rest

test: all  ## every test, after everything they read is there
	ctest --preset release --no-tests=error

bench: build/.built  ## time the parts of an iteration, alone on the machine (a minute)
	cmake --build --preset release --target bench
	@mkdir -p data/generated
	build/tests/bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
	  --benchmark_out=data/generated/bench.json --benchmark_out_format=json
	$(PYTHON) tests/bench/table.py < data/generated/bench.json > data/generated/bench.tsv
	grep -v '^#' data/generated/bench.tsv

sanitize: all  ## the same tests with address and undefined-behaviour sanitizers
	$(require_packages)
	cmake --preset debug > /dev/null
	cmake --build --preset debug
	ctest --preset debug --no-tests=error

readme: all  ## refresh the README's pictures and its generated block
	$(PYTHON) figures/readme.py --write

golden:  ## renew the golden copy of one table, NAME=fig06_orbits; a commit that does says why
	@[ -n "$(NAME)" ] || { echo "golden: say which, for example make golden NAME=fig06_orbits" >&2; exit 2; }
	$(PYTHON) tests/golden.py renew $(NAME)

format:  ## clang-format on all C++ sources
	clang-format -i $$(find src tests -name '*.?pp')

# Files in the order of their names, without dates or owners: the same commit gives the same archive.
version = $(shell sed -nE 's/^project.rotor_stator VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
archive = rotor-stator-$(version)

dist: all  ## an archive of the commit with its tables, figures and pages: build/rotor-stator-VERSION.tar.gz
	@git diff --quiet HEAD || { echo "dist: the work tree differs from the commit" >&2; exit 1; }
	rm -rf build/$(archive)
	mkdir -p build/$(archive)
	git archive HEAD | tar -x -C build/$(archive)
	cp -r --parents data/generated figures/generated build/book build/paper build/$(archive)
	find build/$(archive) \( -name '*.journal' -o -name '*.tmp' \) -delete
	tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -C build -c $(archive) | \
	  gzip -n > build/$(archive).tar.gz
	rm -rf build/$(archive)

list:  ## this list
	@sed -nE 's/^([a-z-]+):.*##  ?(.*)/\1\t\2/p' $(MAKEFILE_LIST) | sort | column -t -s "$$(printf '\t')"

clean:  ## remove everything that was built, computed or drawn
	rm -rf build build-debug data/generated figures/generated
