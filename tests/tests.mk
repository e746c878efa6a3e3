# Tests, timings of parts, golden tables.
test: all  ## every test, after everything that they read is there
sanitize: all  ## the same tests with address and undefined-behaviour sanitizers
test: preset := release
sanitize: preset := debug
test sanitize:
	flock build/.lock cmake --preset $(preset) -DPYTHON=$(PYTHON) > build/configure-$@.log
	flock build/.lock cmake --build --preset $(preset) --target all tests
	flock build/.tests ctest --preset $(preset) --no-tests=error -j $$(nproc)
bench: build/.built  ## time the parts of an iteration, alone on the machine (a minute)
	flock build/.lock cmake --preset release > build/configure.log
	flock build/.lock cmake --build --preset release --target bench
	@mkdir -p data/generated
	$(PYTHON) tests/bench/table.py build/tests/bench | tee data/generated/bench.tsv | grep -v '^#'
golden: $(NAME:%=data/generated/%.tsv)  ## renew one golden table: NAME=fig06_orbits; a commit that does says why
	@$(if $(NAME),$(PYTHON) tests/golden.py renew $(NAME),echo "nothing renewed: make golden NAME=fig06_orbits renews one table" >&2; exit 2)
