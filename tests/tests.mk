# Tests, timings of parts, golden tables.
test: all  ## every test, after everything that they read is there
sanitize: all  ## the same tests with address and undefined-behaviour sanitizers
test: preset := release
sanitize: preset := debug
test sanitize:
	flock build/.lock cmake --preset $(preset) -DPYTHON=$(PYTHON) > build/configure-$@.log
	flock build/.lock cmake --build --preset $(preset) --target all tests
	flock build/.tests ctest --preset $(preset) --no-tests=error -j $$(($$(nproc) + 1))  # some wait
build/tests/judge: tests/truth/judge.cpp build/.built
	flock build/.lock cmake --build --preset release --target judge
data/generated/hard_cases.tsv: build/tests/judge
bench: build/.built  ## time the parts of an iteration, alone on the machine (a minute)
	flock build/.lock cmake --preset release > build/configure.log
	flock build/.lock cmake --build --preset release --target bench
	@mkdir -p data/generated
	$(PYTHON) tests/bench/table.py build/tests/bench | tee data/generated/bench.tsv | grep -v '^#'
golden: $(NAME:%=data/generated/%.tsv)  ## renew one golden table: NAME=fig06_orbits; a commit that does says why
	@$(if $(NAME),$(PYTHON) tests/golden.py renew $(NAME),echo "nothing renewed: make golden NAME=fig06_orbits renews one table" >&2; exit 2)

# What attacks: readers against libFuzzer, each for a minute, and random questions to explore; `test-all` tries other ones
# with each commit and renews the counts of the page tests/hard/attacks.md.
.PHONY: fuzz test-all
has_fuzzer = echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' | \
  clang++ -fsanitize=fuzzer,address -x c++ -o build/fuzz/none - 2> /dev/null
build/fuzz/%: fuzzed = clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Isrc -Ibuild -DTOML_HEADER_ONLY=0 \
  -idirafter $(dir $(shell g++ -print-file-name=include/omp.h)) -isystem /usr/include/eigen3
build/fuzz/readers: $(patsubst %.cpp,build/fuzz/%.o,$(wildcard src/io/*.cpp src/model/*.cpp) tests/fuzz/readers.cpp)
	$(fuzzed) -Wl,--unresolved-symbols=ignore-all -o $@ $^ -ltomlplusplus -lgomp  # readers call no solver
build/fuzz/%.o: %.cpp $(sources) | build/.built
	@mkdir -p $(@D)
	$(fuzzed) -c -o $@ $<
fuzz:  ## readers of files against libFuzzer, each for a minute, where clang has it
	@mkdir -p build/fuzz; $(has_fuzzer) || { echo "make fuzz: needs clang++ with libFuzzer: clang and libclang-rt-14-dev of Debian" >&2; exit 2; }
	$(MAKE) build/fuzz/readers
	$(PYTHON) tests/fuzz/fuzz.py
test-all: export FULL := 1
test-all: test  ## every test with all its cases, then ten minutes of attacks that no commit has seen before
	@mkdir -p build/fuzz; if $(has_fuzzer); then $(MAKE) build/fuzz/readers; else rm -f build/fuzz/readers; echo "no libFuzzer here: no reader is attacked" >&2; fi
	$(PYTHON) tests/hard/attack.py
