# The commands that a person and CI both run. `make demo` and `make test` set themselves up.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: bench demo test test-slow torture torture-numpy campaign-quick verify docs check format clean
.DEFAULT_GOAL := demo

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.demo-installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[plot]'
	@touch $@

$(VENV)/.dev-installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[all,dev]'
	@touch $@ $(VENV)/.demo-installed

$(VENV)/.docs-installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[docs]'
	@touch $@

demo: $(VENV)/.demo-installed
	$(BIN)/python scripts/demo

test: $(VENV)/.dev-installed
	$(BIN)/python -m pytest -m "not slow" -n auto --dist loadfile

test-slow: $(VENV)/.dev-installed
	$(BIN)/python -m pytest -m slow

torture: $(VENV)/.dev-installed
	$(BIN)/python scripts/torture

# the oldest numpy that pyproject.toml admits and the newest there is, each in an environment of its own
torture-numpy:
	$(PYTHON) scripts/torture-numpy

campaign-quick: $(VENV)/.dev-installed
	$(BIN)/regen-surrogate --quick --jobs 2

# what the pages say of speed: on an idle machine, which these ten minutes write into the pages
bench: $(VENV)/.dev-installed
	$(BIN)/python -m pip install --quiet --editable '.[bench]'
	$(BIN)/python scripts/bench-runtime
	$(BIN)/python scripts/bench-tradeoff

verify: $(VENV)/.dev-installed
	$(BIN)/python -m fe_training verify --jobs 2

docs: $(VENV)/.docs-installed
	$(BIN)/python scripts/gallery docs/_gallery
	$(BIN)/sphinx-build -q -W --keep-going -b html docs docs/_build/html

check: $(VENV)/.dev-installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: $(VENV)/.dev-installed
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean:
	rm -rf $(VENV) build dist docs/_build docs/_gallery .pytest_cache .mypy_cache .ruff_cache .hypothesis
