# make demo    installs what is missing, builds lptn, runs the gearbox
# make test    the same set-up, then every test
# make fuzz    feeds six readers with inputs guided by coverage, FUZZ_MINUTES (5) each; fuzz/run says how
# SUNDIALS=bundled make demo    builds SUNDIALS itself: needs gcc, cmake and libclang only

SUNDIALS ?= system
export SUNDIALS
features = $(if $(filter bundled,$(SUNDIALS)),--features lptn/bundled)

.PHONY: demo test build setup setup-tests bench fuzz clean

demo: build
	./target/release/lptn run networks/gearbox.toml

build: setup
	cargo build --release --locked -p lptn-cli -p lptn $(features)

test: setup-tests
	cargo test --workspace --locked $(features)

bench: setup
	cargo bench --locked --workspace $(features)

fuzz:
	@./fuzz/run

setup:
	@./.ci/setup

setup-tests:
	@./.ci/setup --tests

clean:
	cargo clean
