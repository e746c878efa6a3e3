# Other people's programs on the same equations.
peers: $(call table,$(peers))  ## other people's programs on the same equations (10 minutes)
$(call table,$(peers) tab03_answers): data/generated/%.tsv: peers/%.py data/scenes/%.toml build/peers/.built
	$(whole) OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 flock build/.timing $(PYTHON) $< $(word 2,$^) > $$new; mv $$new $@
build/peers/.built: $(wildcard peers/*.*pp peers/*.py peers/CMake*) build/.built
	flock build/.lock cmake -S peers --preset release > build/configure-peers.log
	flock build/.lock cmake --build build/peers
	$(PYTHON) peers/check.py data/scenes/peers.toml
	@touch $@
