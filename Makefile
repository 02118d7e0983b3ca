# Two commands matter: `make run` and `make test`. Both build what is missing and rebuild after a Rust edit.
# With uv on the path it makes the environment; otherwise python3 -m venv and pip do.

PYTHON ?= python3
VENV   ?= .venv
OUT    ?= out

BIN    := $(VENV)/bin
UV     := $(shell command -v uv 2>/dev/null)
# What running takes is installed first, so that a first study need not wait for what testing takes.
STAMP  := $(VENV)/.installed
TOOLS  := $(VENV)/.tools
# Prints the Python dependencies, one a line: pip reads no pyproject.toml.
DEPENDENCIES := import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["dependencies"], sep="\n")
# Where the programs are that exports are for: half a gigabyte.
PROGRAMS := target/programs/.installed

# maturin builds into the environment named here, and refuses to guess between this one and conda's.
export VIRTUAL_ENV := $(abspath $(VENV))
unexport CONDA_PREFIX

# Where the notebooks are that the widget is tried in.
NOTEBOOKS := target/notebooks/.installed

.DEFAULT_GOAL := help
.PHONY: help run study test check-long develop lint bench docs wasm wheel clean

help: ## list the commands
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-11s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

run: develop ## run the paper's study in small: figures, verdicts on its claims, out/report.html
	$(BIN)/drumrs reproduce --quick --out $(OUT)

study: develop ## run the paper's study in full (about an hour and a half on two cores) and keep it in docs/study
	$(BIN)/drumrs reproduce --out $(OUT)/study
	mkdir -p docs/study/figures
	cp $(OUT)/study/table.parquet docs/study/
	cp $(OUT)/study/summary.md docs/study/README.md
	cp $(OUT)/study/figures/*.png docs/study/figures/

test: develop $(TOOLS) ## test the physics, the package and the documentation
	@if command -v cargo-nextest >/dev/null; then cargo nextest run --no-fail-fast; else cargo test --lib --tests --no-fail-fast; fi
	cargo test --doc
	$(BIN)/python -m pytest --numprocesses 2 --dist loadfile -m "not slow"

check-long: develop $(TOOLS) $(PROGRAMS) $(NOTEBOOKS) ## test what takes hours, with a table of what passed; PARTS="fuzz study" for some of it (.ci/long says what)
	.ci/long $(PARTS)

$(PROGRAMS):
	$(PYTHON) -m venv target/programs
	target/programs/bin/python -m pip install --disable-pip-version-check --quiet 'vtk>=9.4' 'ovito>=3.12'
	@touch $@

$(NOTEBOOKS): $(TOOLS)
	$(BIN)/python -m venv target/notebooks
	target/notebooks/bin/python -m pip install --disable-pip-version-check --quiet 'jupyterlab>=4.4,<5' 'marimo>=0.20' 'anywidget>=0.10,<1'
	@touch $@

develop: $(STAMP) ## build the core into the environment (.venv)
	$(BIN)/maturin develop --release --skip-install --quiet

lint: develop $(TOOLS) ## check format, lints, layers, types and the stub of the core
	cargo fmt --check
	cargo clippy --all-targets --features python,baseline -- -D warnings
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports --no-cache
	$(BIN)/mypy
	cd benches/peers && MYPYPATH=../../python:. ../../$(BIN)/mypy --config-file ../../pyproject.toml *.py ../*.py
	cd python && ../$(BIN)/python -m mypy.stubtest drumrs._core --mypy-config-file ../pyproject.toml

bench: ## measure the speed of a step
	cargo bench

docs: develop $(TOOLS) ## build the documentation site, out/docs/index.html
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --quiet
	$(BIN)/python -m sphinx --fail-on-warning --keep-going -b html docs $(OUT)/docs

# Within wasm/, whose own settings hold there. It takes the target: rustup target add wasm32-unknown-unknown.
wasm: ## build the core for WebAssembly; the first page of the site then has a drum that runs in it
	cd wasm && cargo build --profile web --locked --lib --target wasm32-unknown-unknown
	cd wasm && cargo run --locked --quiet --package bindings -- \
	    ../target/wasm/wasm32-unknown-unknown/web/drumrs_wasm.wasm ../target/wasm/page

wheel: ## build the wheel for this machine into dist/, check it, and try it where there is no Rust
	$(PYTHON) packaging/wheel.py

clean: ## remove everything built
	cargo clean
	rm -rf $(VENV) $(OUT) dist python/drumrs/*.so

# The Python dependencies are installed once and again when they change; a Rust edit only rebuilds the core. The first time
# they are fetched while it is compiled: not by a second maturin, for the two would take the finished library from each other.
$(STAMP): pyproject.toml Cargo.toml
ifdef UV
	test -x $(BIN)/python || $(UV) venv --python '>=3.11' $(VENV)
	$(UV) pip install 'maturin>=1.13,<2'
	$(UV) pip install --quiet -r pyproject.toml & $(BIN)/maturin develop --release --skip-install --quiet; wait
	$(BIN)/maturin develop --release --uv
else
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "drumrs needs Python 3.11 or later; set PYTHON=")'
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --disable-pip-version-check --quiet 'maturin>=1.13,<2'
	$(BIN)/python -c '$(DEPENDENCIES)' | $(BIN)/python -m pip install --disable-pip-version-check --quiet -r /dev/stdin & \
	    $(BIN)/maturin develop --release --skip-install --quiet; wait
	$(BIN)/maturin develop --release
endif
	@touch $@

$(TOOLS): $(STAMP)
	$(BIN)/maturin develop --release --extras dev $(if $(UV),--uv)
	@touch $@
