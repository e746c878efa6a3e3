# Texts with the numbers of tables, pages, article, archive. `whole`, `table` and the lists are those of the Makefile.
data/generated/article.tsv: paper/article_values.py paper/article_results.py figures/claims.py CITATION.cff studies/map_scaling.py $(judging) $(reader) data/scenes/validity.toml \
  data/set1.toml data/set1-as-printed.toml paper/deviations.md $(call table,$(paper) $(beside) sensitivity_derivatives truth_intervals, \
  fig03_response tab01_parameters) $(claims) build/environment.txt build/explore $(wildcard data/reference/*.tsv data/reference/as-printed/*.tsv \
  data/rotors/*.toml data/live/*.toml) data/set2.toml figures/rotor_stator/__init__.py
	$(whole) $(PYTHON) $< > $$new; mv $$new $@
data/generated/deviations.md data/generated/article.md: data/generated/%.md: paper/include.py paper/%.md data/generated/%.tsv
	$(whole) $(PYTHON) $^ > $$new; mv $$new $@
data/generated/beyond.md: paper/include.py paper/beyond.md data/generated/article.tsv
	$(whole) $(PYTHON) $^ > $$new; mv $$new $@
data/generated/cage.md data/generated/map_scaling.md: data/generated/%.md: studies/%.py data/reference/%.tsv figures/tables.py
	$(whole) $(PYTHON) $< data/reference/$*.tsv > $$new; mv $$new $@
data/generated/map_scaling.md: $(patsubst %,data/reference/%.tsv,clearance_speed stiffness_border map_checks)
data/generated/manual.md: paper/manual.py build/explore data/set1.toml data/rotors/overhung.toml
	$(whole) $(PYTHON) $< > $$new; mv $$new $@

book: build/book/.built  ## programs, figures and texts as pages, with a search: build/book/index.html
build/book/.built: $(wildcard paper/book/* *.md paper/*.md tests/hard/*.md paper/references.bib studies/*.py peers/*.py data/reference/*.tsv build/live/index.html) \
  $(sources) $(untimed) $(timings) $(claims) data/generated/article.tsv data/generated/beyond.md
	flock build/.pages bash -c 'mkdir -p build/book-pages && $(PYTHON) -m sphinx -q -W --keep-going -a -c paper/book -d build/book-pages/.trees build/book-pages $(@D)'
	@touch $@
article: build/paper/article.html  ## the article: build/paper/article.html
build/paper/article.html: data/generated/article.md paper/render_article.py paper/article.html paper/article.css paper/book/figures.toml paper/references.bib \
  $(shell sed -nE 's/^!\[.*\]\(figures\/(.*\.svg)\)$$/figures\/generated\/\1/p' paper/article.md) | build/book/.built
	$(PYTHON) paper/render_article.py $< $@
pdf: build/paper/article.pdf  ## the article as PDF
build/paper/article.pdf: data/generated/article.md paper/article.tex build/paper/article.html
	$(PYTHON) paper/render_article.py $< $@

# Files in the order of their names, without dates or owners: the same commit gives the same archive.
archive := rotor-stator-$(shell sed -nE 's/^project.rotor_stator VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
dist: all  ## an archive of the commit with its tables, figures and pages: build/rotor-stator-VERSION.tar.gz
	@git diff --quiet HEAD || { echo "dist: the work tree differs from the commit" >&2; exit 1; }
	new=build/$(archive).tar.gz.$$BASHPID.tmp; trap 'rm -f $$new' EXIT; { git ls-files; find data/generated figures/generated build/book build/paper $(wildcard build/live/index.html) -type f ! -name '*.tmp*'; } | \
	  sort | tar --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=go+u,go-w --transform 's,^,$(archive)/,' -T - -c | gzip -n > $$new; mv $$new build/$(archive).tar.gz
