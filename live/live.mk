# The live page: the rooms of the core and what of explore computes motions, by the compiler for the browser. That of
# Debian 12 lacks parts of the library of C++20 (live/libcxx.hpp) and looks for its parser where only Debian's node does.
# Exceptions are WebAssembly's own (browsers of 2022 and later): by JavaScript's the module was a quarter larger.
live_sources := $(filter-out src/io/program.cpp src/time/gsl.cpp $(patsubst %,src/explore/%.cpp, \
    attractors campbell check map% options plot runup shaft shape), \
  $(wildcard $(patsubst %,src/%/*.cpp,io model balance continuation time motion explore))) \
  live/live.cpp live/no_gsl.cpp
live_objects := $(live_sources:%.cpp=build/live/%.o)
live_flags := -O2 -DNDEBUG -ffp-contract=off -fno-math-errno -fwasm-exceptions
export NODE_PATH ?= /usr/share/nodejs

build/model/bearing_catalogue.hpp: data/bearings/deep_groove.toml CMakeLists.txt
	@mkdir -p build; cmake --preset release > build/configure.log; touch $@
build/live/include/.stamped: build/model/bearing_catalogue.hpp $(sources)
	@mkdir -p $(@D); ln -sfn $$(pkg-config --variable=includedir tomlplusplus)/toml++ $(@D)/toml++
	ln -sfn $$(pkg-config --variable=includedir tomlplusplus)/nlohmann $(@D)/nlohmann
	sh src/io/stamp_revision.sh $$(sed -nE 's/^project.rotor_stator VERSION ([0-9.]+).*/\1/p' CMakeLists.txt) \
	  "$(live_flags)" $(@D)/source_revision.hpp; touch $@
build/live/include/source_revision.hpp: build/live/include/.stamped
	+@:

$(live_objects): build/live/%.o: %.cpp live/live.mk | build/live/include/source_revision.hpp
	@mkdir -p $(@D)
	em++ -std=c++20 $(live_flags) -DEIGEN_DONT_PARALLELIZE -DROTOR_STATOR_EIGEN_FFT -include live/libcxx.hpp -Ilive -Isrc \
	  -Ibuild/live/include -Ibuild $$(pkg-config --cflags eigen3) -MMD -MP -c $< -o $@
-include $(live_objects:.o=.d)

build/live/core.js: $(live_objects)
	em++ $(live_flags) $^ -o $@ -sMODULARIZE=1 -sEXPORT_NAME=createCore -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=2MB \
	  -sENVIRONMENT=worker,node -sEXPORTED_RUNTIME_METHODS=ccall,UTF8ToString

build/live/index.html: live/assemble.py build/live/core.js $(wildcard live/*.* data/*.toml data/live/*)
	$(PYTHON) $< build/live/core.js build/live/core.wasm $@.tmp; mv $@.tmp $@
