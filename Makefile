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

# READING=as-printed draws the paper's printed frequencies (deviation D-09) beside the default.
READING ?= exchanged
ifeq ($(filter $(READING),exchanged as-printed),)
$(error READING=$(READING): must be exchanged or as-printed)
endif
suffix := $(if $(filter as-printed,$(READING)),-as-printed)
folder := $(if $(filter as-printed,$(READING)),/as-printed)

tables_dir := data/generated$(folder)
figures_dir := figures/generated$(folder)

# What the paper leaves out is varied about the default reading alone.
varied := $(if $(filter exchanged,$(READING)),sensitivity)

figure_names := fig01 fig02 fig03 fig04 fig05 fig06 fig07 fig08 fig09 $(varied)
table_names := $(figure_names) tab01_parameters $(varied:%=%_derivatives)
tables := $(table_names:%=$(tables_dir)/%.tsv)
timing := $(tables_dir)/tab02_timing.tsv
figures := $(figure_names:%=$(figures_dir)/%.svg)
pictures := $(figures:.svg=.png)
programs := $(patsubst src/%.cpp,build/%,$(wildcard src/*.cpp))

.PHONY: all figures timing test sanitize deps list png readme golden format clean

all: figures  ## every figure and table of the paper, and the tests' programs (the default)

figures: $(tables) $(timing) $(figures)  ## the paper's figures and tables

timing: $(timing)  ## the timing table, alone on the machine

# ---------------------------------------------------------------------------------------------
# Packages

packages := cmake ninja-build g++ pkg-config libeigen3-dev libfftw3-dev libgsl-dev \
  libtomlplusplus-dev libcli11-dev catch2 gnuplot-nox python3-matplotlib librsvg2-bin git

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

# When deps is asked for, everything else waits for it, with -j too.
build/.built: | $(filter deps,$(MAKECMDGOALS))

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

define table
$$(tables_dir)/$(1).tsv: build/$(2) data/scenes/$(or $(4),$(1)).toml $(3:%=data/%$$(suffix).toml) | $$(tables_dir)
	$$(call whole,$$< data/scenes/$(or $(4),$(1)).toml --reading $$(READING) > $$$$new)
endef

$(eval $(call table,fig01,fig01_bearing,set1))
$(eval $(call table,fig02,fig02_ball_position,set1))
$(eval $(call table,fig03,fig03_response,set1 set2))
$(eval $(call table,fig04,fig04_displacements,set1))
$(eval $(call table,fig05,fig05_displacements,set1))
$(eval $(call table,fig06,fig06_orbits,set1))
$(eval $(call table,fig07,fig07_contact,set1))
$(eval $(call table,fig08,fig08_orbits,set2))
$(eval $(call table,fig09,fig09_contact,set2))
$(eval $(call table,tab01_parameters,tab01_parameters,set1 set2))
$(eval $(call table,tab02_timing,tab02_timing,set1))
$(eval $(call table,sensitivity,sensitivity,set1))
$(eval $(call table,sensitivity_derivatives,sensitivity_derivatives,set1,sensitivity))

# Timings run after everything else, alone.
$(timing): | $(tables) $(figures)

# ---------------------------------------------------------------------------------------------
# Figures: $(call curves,name,script,what it loads) with gnuplot, $(call map,…) with Matplotlib

define curves
$$(figures_dir)/$(1).svg: figures/$(2).gp figures/style.gp $(3) $$(tables_dir)/$(1).tsv | $$(figures_dir)
	$$(call whole,gnuplot -e "table='$$(tables_dir)/$(1).tsv'; output='$$$$new'" $$<)
endef

define map
$$(figures_dir)/$(1).svg: figures/$(2).py figures/rotor_stator.mplstyle figures/tables.py $(3) $$(tables_dir)/$(1).tsv | $$(figures_dir)
	$$(call whole,$$(PYTHON) $$< $$(tables_dir)/$(1).tsv $$$$new)
endef

$(eval $(call map,fig01,fig01_bearing,))
$(eval $(call map,fig02,fig02_ball_position,))
$(eval $(call curves,fig03,fig03_response,))
$(eval $(call curves,fig04,fig04_displacements,figures/displacements.gp))
$(eval $(call curves,fig05,fig05_displacements,figures/displacements.gp))
$(eval $(call curves,fig06,fig06_orbits,figures/orbits.gp))
$(eval $(call map,fig07,fig07_contact,figures/contact_map.py))
$(eval $(call curves,fig08,fig08_orbits,figures/orbits.gp))
$(eval $(call map,fig09,fig09_contact,figures/contact_map.py))
$(eval $(call curves,sensitivity,sensitivity,))

png: $(pictures)  ## the figures as PNG, for viewing

%.png: %.svg
	$(call whole,rsvg-convert --zoom 1.5 --background-color white --output $$new $<)

$(tables_dir) $(figures_dir):
	@mkdir -p $@

# ---------------------------------------------------------------------------------------------
# Checks and the rest

test: all  ## every test, after everything they read is there
	ctest --preset release --no-tests=error

sanitize: all  ## the same tests with address and undefined-behaviour sanitizers
	$(require_packages)
	cmake --preset debug > /dev/null
	cmake --build --preset debug
	ctest --preset debug --no-tests=error

readme: figures  ## refresh the README's pictures and its generated block
	$(PYTHON) figures/readme.py --write

golden:  ## rewrite the golden tables of the tests from data/generated; a commit that does says why
	$(PYTHON) tests/make_golden.py

format:  ## clang-format on all C++ sources
	clang-format -i $$(find src tests -name '*.?pp')

list:  ## this list
	@sed -nE 's/^([a-z]+):.*##  ?(.*)/\1\t\2/p' $(MAKEFILE_LIST) | sort | column -t -s "$$(printf '\t')"

clean:  ## remove everything that was built, computed or drawn
	rm -rf build build-debug data/generated figures/generated
