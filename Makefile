# make demo    installs what is missing, builds lptn, runs the gearbox
# make test    the same set-up, then every test
# make bench   runs lptn beside other programs at the same error, some 15 minutes, and writes the tables of docs/speed.md.
#              BENCH="ladder-1000 grid2d-32" TARGET=1e-6 TURNS=5 choose, and then only print. docs/speed.md says more
# make bench-all    the same with steady states, a million nodes and an error of 1e-6: an hour
# make bench-micro  the benchmarks inside crates (cargo bench)
# make audit   licences, doubles and known holes of the dependencies; the tests of the unsafe crate under valgrind
# make mutants installs cargo-mutants if it is missing, breaks lptn-assembly, -reduce, -network and -units in one place after
#              another (5,496 in all) and runs the tests of the crate each time: some ten hours on two cores. Results go to
#              target/mutants/CRATE. MUTANTS="--shard 1/40" takes every fortieth place, in a quarter of an hour.
# make metamorphic    asks every relation and every verb of random networks: METAMORPHIC (2000) of them from the seed
#              METAMORPHIC_FROM (1000) on, about an hour on two cores; the smallest network that differs is printed
# make fuzz    feeds six readers with inputs guided by coverage, FUZZ_MINUTES (5) each; fuzz/run says how
# make dist    packs one program that runs on any Linux for x86-64, with manual pages, completions and networks, and a
#              Python wheel: target/dist and target/wheels. See docs/install.md
# make wheel   packs the Python module and the program in one wheel, target/wheels: pip install target/wheels/lptn-*.whl
# make test-wheel   the same, installs it into an empty environment and runs the tests of the package
# make book    installs mdBook if it is missing and builds docs/ as a book, target/book/index.html, equations as MathML
# make check-wasm  builds the core, which knows no C, for WebAssembly; says SKIPPED where no Rust can
# make live    builds the core of live pages (lptn run --report --live) for WebAssembly, some minutes the first time; says
#              SKIPPED where no Rust can. make demo and make test put it into the program if it is made, make dist and make
#              wheel make it. LIVE=no leaves it out
# SUNDIALS=bundled make demo    builds SUNDIALS itself: needs gcc, cmake and libclang only

SUNDIALS ?= system
export SUNDIALS
features = $(if $(filter bundled,$(SUNDIALS)),--features lptn-cli/bundled)

.PHONY: demo test test-kills test-slurm test-hyperqueue build dist wheel test-wheel book setup setup-tests setup-bench bench bench-all bench-micro audit fuzz metamorphic mutants check-wasm live clean

demo: build
	./target/release/lptn run networks/gearbox.toml

build: setup
	@LIVE=made ./.ci/with-live ./.ci/build $(features)

dist:
	@./.ci/with-live ./.ci/dist

wheel: setup
	@./.ci/with-live ./.ci/wheel

test-wheel: wheel
	@./.ci/test-wheel

test: setup-tests
	@LIVE=made ./.ci/with-live cargo test --workspace --locked $(features)

# A sweep that is killed fifty times.
test-kills: setup-tests
	cargo test --workspace --locked $(features) --test all sweep_resume:: -- --ignored

# A sweep as a job array of a Slurm of its own on this machine; as root.
test-slurm: build
	@./.ci/test-slurm

test-hyperqueue: build
	@./.ci/test-hyperqueue

bench: setup-bench build
	@./benches/run

bench-all: setup-bench build
	@./benches/run --all

bench-micro: setup
	cargo bench --locked --workspace $(features)

# cargo-mutants ends with 2 or 3 where something was not noticed or did not end: that is a result, not a failure.
mutants: setup-tests
	@command -v cargo-mutants >/dev/null || cargo install cargo-mutants --locked
	@for crate in lptn-assembly lptn-reduce lptn-network lptn-units; do \
	    mkdir -p target/mutants/$$crate; \
	    cargo mutants --package $$crate --output target/mutants/$$crate $(MUTANTS); \
	    case $$? in 0|2|3) ;; *) exit 1 ;; esac; \
	done

METAMORPHIC ?= 2000
METAMORPHIC_FROM ?= 1000
metamorphic: setup-tests
	LPTN_METAMORPHIC=$(METAMORPHIC) LPTN_METAMORPHIC_FROM=$(METAMORPHIC_FROM) \
	    cargo test --locked $(features) -p lptn-cli --test all metamorphic:: -- --nocapture

fuzz:
	@./fuzz/run

book:
	@command -v mdbook >/dev/null || cargo install mdbook --locked
	cargo build --release --locked --manifest-path book/prepare/Cargo.toml --target-dir target/book-prepare
	mdbook build book
	@echo "target/book/index.html"

audit:
	@./.ci/audit

check-wasm:
	@./.ci/check-wasm

live:
	@./.ci/live

setup:
	@./.ci/setup

setup-bench:
	@./.ci/setup --bench

setup-tests:
	@./.ci/setup --tests

clean:
	cargo clean
