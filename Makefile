# `make sheet`, `make web` and `make test` set up everything they need in .venv; the same steps in plain pip: kulman guide install, docs/commands.md
PYTHON ?= python3
PY := .venv/bin/python
VARIANT ?= 3
USABLE := .venv/usable
READY := .venv/ready
WORKERS ?= auto
# what the tests start is compiled once, whatever the shell says: they start some hundred processes
unexport PYTHONDONTWRITEBYTECODE

.PHONY: sheet web test soak browser corpus lint types bench speed photos clean

sheet: $(USABLE)
	mkdir -p out
	$(PY) -m kulman sheet nau-slider-crank -v $(VARIANT) -o out/sheet.svg -o out/sheet.pdf

# the program in a browser
web: $(USABLE)
	$(PY) -m kulman serve --open

test: $(READY)
	$(PY) -m pytest -q -n $(WORKERS) --dist worksteal -m "not soak" --ignore tests/browser  # which make browser runs

soak: $(READY)
	$(PY) -m pytest -q -n $(WORKERS) --dist worksteal -m soak --ignore tests/browser  # which make browser runs

# pages, driven in the system's Chromium
browser: $(READY)
	$(PY) -m pip install --quiet --disable-pip-version-check --editable ".[browser]"
	KULMAN_BROWSER=required $(PY) -m pytest -q tests/browser

# all outputs that the tests know by their digests, beside what they were
corpus: $(READY)
	$(PY) -m kulman.tests.corpus.corpus

lint: $(READY)
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .

types: $(READY)
	mkdir -p .typing
	ln -sfn .. .typing/kulman
	$(PY) -m mypy

# Kulman beside others; make bench PEERS=/tmp/peers/bin/python: with the peers that benchmarks/peers.py names
PEERS ?= $(PY)
bench: $(READY)
	$(PEERS) benchmarks/peers.py

# Kulman's own speed against its goals
speed: $(READY)
	$(PY) benchmarks/run.py

# how well photographs of sheets drawn by hand are read: so many students, on all linkages or those of TASKS
STUDENTS ?= 60
photos: $(READY)
	$(PY) -m kulman.tests.photos.measure $(STUDENTS) $(TASKS)

# what a user needs; what the tests need takes several times as long
$(USABLE): pyproject.toml
	@echo "The first time packages are fetched and installed: a minute or so ..."
	$(PYTHON) -m venv .venv
	$(PY) -m pip install --quiet --disable-pip-version-check --editable ".[docx,dxf,note,png,scan,web]"
	touch $(USABLE)

$(READY): $(USABLE)
	$(PY) -m pip install --quiet --disable-pip-version-check --editable ".[dev,png]"
	touch $(READY)

clean:
	rm -rf .venv .typing build out *.egg-info
