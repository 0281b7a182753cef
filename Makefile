# Everyday commands; `make help` lists them. CMake does the work, see CMakePresets.json.
.DEFAULT_GOAL := help
.PHONY: help run test build bench format check clean dependencies configure test-dependencies test-configure

BUILD := build/release
CASE ?= examples/crossing_cracks/case.toml
# The demonstration may replace its own results; those of a case that somebody chose are not ours to replace.
OVERWRITE := $(if $(filter file,$(origin CASE)),--overwrite)
JOBS ?= $(shell nproc)
SOURCES = $(shell find src app tests bench -name '*.hpp' -o -name '*.cpp')

help:  ## this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-8s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

run: configure  ## installs what is missing, builds the program and runs an example (or CASE=file)
	@cmake --build $(BUILD) --target peritherm_program --parallel $(JOBS)
	@$(BUILD)/peritherm run $(CASE) $(OVERWRITE)

test: test-configure  ## installs what is missing, builds everything and runs all tests
	@cmake --build $(BUILD) --parallel $(JOBS)
	@ctest --test-dir $(BUILD) --parallel 2 --output-on-failure --no-tests=error

build: configure  ## builds the program
	@cmake --build $(BUILD) --target peritherm_program --parallel $(JOBS)

bench: test-configure  ## builds and runs the benchmarks; BENCH="--quick --only crack" chooses
	@cmake --build $(BUILD) --target peritherm_bench --parallel $(JOBS)
	@$(BUILD)/bench/peritherm_bench --json $(BUILD)/bench.json $(BENCH)

format:  ## formats all C++ files
	@clang-format -i $(SOURCES)

check:  ## checks the format and the rooms
	@clang-format --dry-run --Werror $(SOURCES)
	@python3 tools/check_rooms.py .

clean:  ## removes what was built (results stay)
	@rm -rf build

dependencies:
	@tools/install_dependencies.sh run

test-dependencies:
	@tools/install_dependencies.sh test

# Ninja calls CMake again by itself when a CMake file or the set of sources has changed.
configure: dependencies
	@test -f $(BUILD)/build.ninja || cmake --preset release -DPERITHERM_TESTS=OFF -DPERITHERM_BENCH=OFF

test-configure: test-dependencies
	@test -f $(BUILD)/build.ninja && grep -q '^PERITHERM_TESTS:BOOL=ON' $(BUILD)/CMakeCache.txt && \
	  grep -q '^PERITHERM_BENCH:BOOL=ON' $(BUILD)/CMakeCache.txt || \
	  cmake --preset release -DPERITHERM_TESTS=ON -DPERITHERM_BENCH=ON
