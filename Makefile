# Every figure and table of the paper, from source.
#
#   make deps all     installs the packages, builds, computes and draws everything
#   make deps test    the same, then the tests
#   make list         every target with one line
#
# One name from scene to figure: data/scenes/NAME.toml -> src/NAME.cpp or studies/NAME.* -> data/generated/NAME.tsv ->
# figures/NAME.gp or .py -> figures/generated/NAME.svg. `all` computes every scene that has one of these, unless
# its table is kept in data/reference: then it is a long study, and is drawn from the kept table. The printed
# reading of Table 1 (D-09) stands in as-printed/ below data/generated, data/reference and figures/generated.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.SECONDEXPANSION:
export LC_ALL := C
export TZ := UTC
export OMP_WAIT_POLICY := passive
export PYTHONDONTWRITEBYTECODE := 1

PYTHON ?= /usr/bin/python3
READING ?= exchanged
ifeq ($(filter $(READING),exchanged as-printed),)
$(error READING=$(READING): must be exchanged or as-printed)
endif

# Before anything else: the packages of the goals, and one make at a time in this folder. All that a make
# starts inherits the open lock, so that the next make also waits for what outlives a killed one.

goals := $(or $(filter-out deps,$(MAKECMDGOALS)),all)
with_pages := $(filter all book article pdf test sanitize readme dist,$(goals))
packages := $(sort $(if $(filter-out list clean adopt format,$(goals)),cmake g++ git libcli11-dev libeigen3-dev \
    libfftw3-dev libgsl-dev libtomlplusplus-dev ninja-build nlohmann-json3-dev pkg-config) \
  $(if $(filter-out list clean adopt format bench build/%,$(goals)),gnuplot-nox python3-matplotlib) \
  $(if $(with_pages),furo libjs-mathjax pandoc python3-myst-parser python3-sphinx-copybutton python3-sphinxcontrib.bibtex) \
  $(if $(filter test sanitize,$(goals)),catch2 chromium chromium-driver python3-hypothesis python3-selenium) \
  $(if $(filter pdf,$(goals)),librsvg2-bin lmodern texlive-fonts-recommended texlive-latex-recommended texlive-luatex) \
  $(if $(filter studies test sanitize $(basename $(notdir $(wildcard studies/*.yaml))),$(goals)),snakemake) \
  $(if $(filter peers,$(goals)),auto-07p gfortran libsundials-dev python3-scipy) \
  $(if $(filter live,$(goals)),emscripten) $(if $(filter png,$(goals)),librsvg2-bin) $(if $(filter bench,$(goals)),libbenchmark-dev) \
  $(if $(filter format,$(goals)),clang-format-14))

# The packages that dpkg does not have; nothing on systems without dpkg.
missing = command -v dpkg-query > /dev/null || exit 0; comm -13 \
  <(dpkg-query -W -f '$${db:Status-Status} $${Package}\n' $(packages) 2> /dev/null | sed -n 's/^installed //p' | sort) \
  <(printf '%s\n' $(packages)) | tr '\n' ' '

# make -n and make -q change nothing and need no lock.
only_looks := $(findstring n,$(firstword -$(MAKEFLAGS)))$(findstring q,$(firstword -$(MAKEFLAGS)))
ifneq ($(if $(only_looks),$(CURDIR),$(ROTOR_STATOR_LOCKED)),$(CURDIR))
.PHONY: locked $(or $(MAKECMDGOALS),all)
$(or $(MAKECMDGOALS),all): locked ; @:

locked:
	+@exec 99> .lock; flock -n 99 || { echo "another make works in this folder: waiting for its end" >&2; flock 99; }; \
	missing="$(if $(packages),$$($(missing)))"; $(if $(filter deps,$(MAKECMDGOALS)), \
	  if ! command -v apt-get > /dev/null; then \
	    echo "no apt-get here: use the Containerfile or install what these Debian packages hold: $(packages)"; \
	  elif [ -n "$$missing" ]; then \
	    sudo=; if [ "$$(id -u)" != 0 ] && command -v sudo > /dev/null; then sudo=sudo; fi; \
	    $$sudo apt-get update 99>&-; \
	    $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $$missing 99>&-; fi, \
	  if [ -n "$$missing" ]; then echo "missing: $$missing(make deps $(goals) installs them)" >&2; exit 1; fi); \
	ROTOR_STATOR_LOCKED="$(CURDIR)" exec $(MAKE) --no-print-directory $(or $(MAKECMDGOALS),all)
else

# What there is
MAKEFLAGS += --no-builtin-rules
programs := $(basename $(notdir $(wildcard src/*.cpp studies/*.cpp)))
scenes := $(basename $(notdir $(wildcard data/scenes/*.toml)))
mapped := $(basename $(notdir $(wildcard studies/*.yaml)))
scripted := $(filter $(scenes),$(basename $(notdir $(wildcard studies/*.py))))
scripts := $(basename $(notdir $(wildcard figures/*.gp figures/*.py)))
kept := $(filter-out claims,$(basename $(notdir $(wildcard data/reference/*.tsv))))
kept_printed := $(filter-out claims,$(basename $(notdir $(wildcard data/reference/as-printed/*.tsv))))
computed := $(filter-out $(kept),$(filter $(programs) $(scripted),$(scenes)))

# The paper's figures and tables, and what its claims are judged by: in the printed reading too, if all data
# sets of the scene have one (data/NAME-as-printed.toml beside data/NAME.toml).
paper := $(filter fig0% tab0% regimes,$(computed))
sets := $(basename $(notdir $(wildcard data/*.toml)))
unpaired := $(filter-out %-as-printed $(patsubst %-as-printed,%,$(filter %-as-printed,$(sets))),$(sets))
paired := $(filter-out $(basename $(notdir $(shell grep -l $(unpaired:%=-e '"%"') data/scenes/*.toml))),$(paper))

tables := $(patsubst %,data/generated/%.tsv,$(computed) sensitivity_derivatives truth_intervals)
tables_printed := $(patsubst %,data/generated/as-printed/%.tsv,$(paired) truth_intervals)
figures := $(patsubst %,figures/generated/%.svg,$(filter $(computed) $(kept),$(scripts)) sections truncation)
figures_printed := $(patsubst %,figures/generated/as-printed/%.svg,$(filter $(paired) $(kept_printed),$(scripts)) sections truncation)
claims := data/generated/claims.tsv data/generated/as-printed/claims.tsv
intervals := $(claims:claims.tsv=truth_intervals.tsv)
described := cage map_scaling
timings := $(filter %/tab02_timing.tsv,$(tables) $(tables_printed))
untimed := $(filter-out $(timings),$(tables) $(tables_printed)) $(figures) $(figures_printed) $(patsubst %,data/generated/%.md,deviations $(described))
studies := $(filter $(programs) tab02_equal_error_mean $(mapped) $(scripted),$(kept))
unkept := $(filter-out $(kept),$(mapped))
maps := $(filter-out $(basename $(notdir $(wildcard studies/*.py))),$(filter $(kept),$(mapped)))
costs := $(filter tab02% work_precision cost_growth large map_scaling,$(studies))
sources := $(shell find src data/bearings -type f) $(wildcard studies/*.cpp studies/*/*.?pp) CMakeLists.txt CMakePresets.json

shown := $(tables_printed) $(figures_printed)
ifeq ($(READING),exchanged)
shown := $(patsubst %,data/generated/%.tsv,$(paper) truth_intervals) data/generated/deviations.md \
  $(patsubst %,figures/generated/%.svg,$(filter $(paper) $(kept_printed),$(scripts)) sections truncation)
endif
.PHONY: deps all figures timing claims studies truth maps $(unkept) $(studies) adopt peers book article pdf png readme golden \
  live test sanitize bench format dist list clean

all: $(untimed) $(timings) $(claims) build/book/.built build/paper/article.html  ## figures, tables and claims of both readings, pages, article
deps:  ## install the Debian packages that the goals beside it need (goals=NAME: of a goal that is not made now)
	@:
figures: $(shown)  ## the paper's figures and tables, of one READING (exchanged or as-printed)
claims: $(claims)  ## the verdict on each claim, for both readings
	$(PYTHON) figures/claims.py --print $(claims)

# Programs. CMake knows what each one needs: build/.built only says that it had nothing left to do, and a
# program that it did not touch keeps its date. A clone that was moved or copied is configured anew.
build/.built: $(sources)
	@mkdir -p build; [ "$$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' build/CMakeCache.txt 2> /dev/null)" -ef . ] || \
	  rm -rf build/CMakeCache.txt build/CMakeFiles
	cmake --preset release > build/configure.log
	cmake --build --preset release
	@touch $@
# The + runs this nothing under make -q too, which then looks at the program's real date.
$(programs:%=build/%): build/.built
	+@:

build/environment.txt: paper/environment.py build/.built
	$(whole) $(PYTHON) $< > $$new; mv $$new $@

python_tables := figures/tables.py figures/project.py CMakeLists.txt data/claims.toml

# Tables and figures. In the rules the stem is NAME or as-printed/NAME; what $$ begins is looked up when it is
# known. What is written is moved into place when it is complete.
whole = @echo $@; mkdir -p $(@D); new=$@.$$BASHPID.tmp; trap 'rm -f $$new' EXIT;

# The data sets that a scene names.
parameters = $(patsubst %,data/%$(if $(filter as-printed,$(*D)),-as-printed).toml, \
  $(shell sed -nE '/parameters = /s/[^"]*"([^"]*)"[^"]*/\1 /gp' data/scenes/$(*F).toml))

data/generated/%.tsv: build/$$(*F) data/scenes/$$(*F).toml $$(parameters)
	$(whole) $(alone) $< $(word 2,$^) $(if $(filter as-printed,$(*D)),--reading as-printed) > $$new; mv $$new $@

data/generated/tab02_equal_error_mean.tsv: build/tab02_equal_error data/scenes/tab02_equal_error.toml data/set1.toml
	$(whole) $(alone) $< $(word 2,$^) --error mean > $$new; mv $$new $@

data/generated/sensitivity_derivatives.tsv: figures/sensitivity_derivatives.py data/reference/sensitivity.tsv $(python_tables)
	$(whole) $(PYTHON) $(wordlist 1,2,$^) > $$new; mv $$new $@

data/generated/identification.tsv: build/regimes data/claims.toml data/set1-as-printed.toml data/set2-as-printed.toml

# Studies by explore: those without a kept table belong to `all`. Snakemake deals the lines of a map to jobs, and keeps the shards that are done.
$(scripted:%=data/generated/%.tsv) $(scripted:%=data/generated/as-printed/%.tsv): data/generated/%.tsv: studies/$$(*F).py \
  data/scenes/$$(*F).toml $$(parameters) build/explore figures/tables.py
	$(whole) $(PYTHON) $(wordlist 1,2,$^) $(filter as-printed,$(*D)) > $$new; mv $$new $@

$(patsubst %,data/generated/%.tsv,$(filter $(kept),$(mapped))): data/generated/%.tsv: studies/%.yaml studies/Snakefile build/explore
	snakemake --snakefile studies/Snakefile --profile studies/local $@

# Timings run alone: after all that is not timed, one after the other.
$(timings) $(costs:%=data/generated/%.tsv): private alone = flock build/.timing
$(timings): | $(filter-out $(timings),$(if $(filter figures,$(goals)),$(shown)) $(if $(with_pages)$(filter claims,$(goals)),$(untimed)))
$(costs:%=data/generated/%.tsv): | $(if $(filter studies,$(goals)),$(filter-out $(costs),$(studies)))

# Drawn from the kept table if there is one. sections is the drawing of attractors, truncation a second one of validity.
source = $(or $(wildcard data/reference/$(subst sections,attractors,$(subst truncation,validity,$*)).tsv),data/generated/$*.tsv)

figures/generated/%.svg: figures/$$(*F).gp figures/style.gp figures/orbit_axes.gp figures/orbits.gp \
  figures/displacements.gp data/claims.toml $$(source)
	$(whole) gnuplot -e "table='$(source)'; output='$$new'" $<; mv $$new $@

figures/generated/%.svg: figures/$$(*F).py figures/rotor_stator.mplstyle figures/tables.py figures/bearing_sketch.py \
  figures/contact_map.py data/claims.toml $$(source)
	$(whole) $(PYTHON) $< $(source) $$new; mv $$new $@

# What else some of them read.
figures/generated/identification.svg: figures/claim_quantities.py figures/claim_ranges.py
figures/generated/identification.svg figures/generated/clearance_stiffness.svg: data/set1.toml data/set2.toml data/set1-as-printed.toml
$(patsubst %,figures/generated/%.svg,clearance_stiffness $(maps)): figures/map.py data/set1.toml
figures/generated/stability.svg: data/reference/attractors.tsv
figures/generated/work_precision.svg figures/generated/peers.svg: data/reference/peers.tsv data/reference/peers_auto.tsv data/generated/fig03_response.tsv

png: $(patsubst %.svg,%.png,$(figures) $(figures_printed))  ## the figures as PNG, for viewing
%.png: %.svg
	$(whole) rsvg-convert --zoom 1.5 --background-color white --output $$new $<; mv $$new $@

# What follows from tables: intervals, claims, texts, pages. The stem is generated or generated/as-printed.
judging := figures/claim_quantities.py figures/claim_ranges.py data/scenes/fig07_contact.toml data/scenes/fig09_contact.toml
$(intervals): data/%/truth_intervals.tsv: figures/truth_intervals.py $$(subst generated,reference,data/$$*/attractors.tsv) \
  $$(subst generated,reference,data/$$*/validity.tsv) $(python_tables)
	$(whole) $(PYTHON) $(wordlist 1,3,$^) > $$new; mv $$new $@

$(claims): data/%/claims.tsv: figures/claims.py $(judging) $(python_tables) data/reference/clearance_stiffness.tsv \
  data/reference/identification.tsv data/reference/tab02_equal_error.tsv data/reference/large.tsv data/%/tab01_parameters.tsv \
  $$(subst generated,reference,data/$$*/validity.tsv) data/%/fig03_response.tsv data/%/fig07_contact.tsv \
  data/%/fig09_contact.tsv data/%/regimes.tsv data/%/tab02_timing.tsv | $(timings)
	$(whole) $(PYTHON) $< $(@D) $$new; mv $$new $@

data/generated/article.tsv: paper/article_values.py paper/article_results.py studies/map_scaling.py $(judging) $(python_tables) data/scenes/validity.toml \
  data/set1.toml data/set1-as-printed.toml paper/deviations.md $(tables) data/generated/claims.tsv \
  data/generated/as-printed/fig03_response.tsv data/generated/as-printed/tab01_parameters.tsv build/environment.txt build/explore \
  $(wildcard data/reference/*.tsv data/rotors/*.toml data/live/*.toml)
	$(whole) $(PYTHON) $< > $$new; mv $$new $@

# A text with the numbers of the table of the same name.
data/generated/deviations.md data/generated/article.md: data/generated/%.md: paper/include.py paper/%.md data/generated/%.tsv
	$(whole) $(PYTHON) $^ > $$new; mv $$new $@

$(described:%=data/generated/%.md): data/generated/%.md: studies/%.py data/reference/%.tsv figures/tables.py
	$(whole) $(PYTHON) $< data/reference/$*.tsv > $$new; mv $$new $@
data/generated/map_scaling.md: $(patsubst %,data/reference/%.tsv,$(maps) map_checks)

book: build/book/.built  ## programs, figures and texts as pages, with a search: build/book/index.html
build/book/.built: $(wildcard paper/book/* *.md paper/*.md paper/references.bib studies/*.py peers/*.py data/reference/*.tsv build/live/index.html) \
  $(sources) $(untimed) $(timings) $(claims) data/generated/article.tsv
	mkdir -p build/book-pages && $(PYTHON) -m sphinx -q -W --keep-going -c paper/book -d build/book-pages/.trees build/book-pages $(@D) && touch $@
live: build/live/index.html  ## the solver as a page for the browser, one file: build/live/index.html
include live/live.mk

article: build/paper/article.html  ## the article: build/paper/article.html
build/paper/article.html: data/generated/article.md paper/render_article.py paper/article.html paper/article.css paper/book/figures.toml paper/references.bib \
  $(shell sed -nE 's/^!\[.*\]\(figures\/(.*\.svg)\)$$/figures\/generated\/\1/p' paper/article.md)
	$(PYTHON) paper/render_article.py $< $@
pdf: build/paper/article.pdf  ## the article as PDF
build/paper/article.pdf: data/generated/article.md paper/article.tex build/paper/article.html
	$(PYTHON) paper/render_article.py $< $@

# Long studies, computed anew and compared with the tables kept in data/reference.
studies: $(studies) timing  ## the long studies, the two maps and all timings (three hours)
maps: $(maps:%=figures/generated/%.svg)  ## two maps that nobody has published, drawn from their kept tables
$(unkept): %: build/explore
	snakemake --snakefile studies/Snakefile --profile studies/local build/studies/$@/map.tsv
truth: attractors validity stability verdicts adaptive  ## where the periodic solution is true (15 minutes)
timing: $(timings) $(costs)  ## the tables of cost, alone on the machine (10 minutes)
$(studies): $$(subst reference,generated,$$(wildcard data/reference/$$@.tsv data/reference/as-printed/$$@.tsv))
	$(PYTHON) tests/compare_kept.py $^

adopt:  ## keep the studies' tables and the verdicts of data/generated, also of NAME=new_study; a commit that does says why
	@for name in $(kept) claims $(NAME); do for folder in . as-printed; do new=data/generated/$$folder/$$name.tsv; \
	  if [ -e $$new ]; then mkdir -p data/reference/$$folder; cp -v $$new data/reference/$$folder/; fi; done; done

peers: data/generated/peers.tsv data/generated/peers_auto.tsv  ## other people's programs on the same equations (10 minutes)
data/generated/peers.tsv data/generated/peers_auto.tsv: data/generated/%.tsv: peers/%.py data/scenes/%.toml build/peers/.built
	$(whole) OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 flock build/.timing $(PYTHON) $< $(word 2,$^) > $$new; mv $$new $@

build/peers/.built: $(wildcard peers/*.*pp peers/*.py peers/CMake*) build/.built
	cmake -S peers --preset release > build/configure-peers.log
	cmake --build build/peers
	$(PYTHON) peers/check.py data/scenes/peers.toml
	@touch $@

# Checks and the rest
test: all  ## every test, after everything that they read is there
	cmake --preset release -DPYTHON=$(PYTHON) > build/configure.log
	cmake --build --preset release --target tests
	ctest --preset release --no-tests=error -j $$(nproc)

sanitize: all  ## the same tests with address and undefined-behaviour sanitizers
	cmake --preset debug > build/configure-debug.log
	cmake --build --preset debug --target all tests
	ctest --preset debug --no-tests=error -j $$(nproc)

bench: build/.built  ## time the parts of an iteration, alone on the machine (a minute)
	cmake --preset release > build/configure.log
	cmake --build --preset release --target bench
	@mkdir -p data/generated
	$(PYTHON) tests/bench/table.py build/tests/bench | tee data/generated/bench.tsv | grep -v '^#'

readme: all  ## refresh the README's pictures and its generated block
	$(PYTHON) figures/readme.py --write
golden: $(NAME:%=data/generated/%.tsv)  ## renew one golden table: NAME=fig06_orbits; a commit that does says why
	@$(if $(NAME),$(PYTHON) tests/golden.py renew $(NAME),echo "nothing renewed: make golden NAME=fig06_orbits renews one table" >&2; exit 2)
format:  ## clang-format on all C++ sources
	clang-format-14 -i $$(find src tests peers -name '*.?pp')

# Files in the order of their names, without dates or owners: the same commit gives the same archive.
archive := rotor-stator-$(shell sed -nE 's/^project.rotor_stator VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
dist: all  ## an archive of the commit with its tables, figures and pages: build/rotor-stator-VERSION.tar.gz
	@git diff --quiet HEAD || { echo "dist: the work tree differs from the commit" >&2; exit 1; }
	{ git ls-files; find data/generated figures/generated build/book build/paper $(wildcard build/live/index.html) -type f ! -name '*.tmp*'; } | \
	  sort | tar --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=go+u,go-w --transform 's,^,$(archive)/,' -T - -c | \
	  gzip -n > build/$(archive).tar.gz

list:  ## this list
	@sed -nE 's/^([a-z-]+):.*##  ?(.*)/\1\t\2/p' Makefile | sort | column -t -s "$$(printf '\t')"
	@echo "One study: make NAME, of $(studies)"
clean:  ## remove everything that was built, computed or drawn
	rm -rf build build-debug data/generated figures/generated
endif
