#!/usr/bin/env bash
# What a release offers to download: wheels for old and new Linux systems, and programs that need nothing of the system.
#
#   python/release.sh FOLDER [TARGET...]      FOLDER: where it all goes; otherwise every target below
#
# Zig, from PyPI, compiles the C parts (SQLite, zstd) and links for every target, so that one machine makes them all; Rust's
# own library for a target comes from `rustup target add TARGET`, or is said to be missing.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cache="${EYEBOLT_CI_CACHE:-$HOME/.cache/eyebolt-ci}/python"
folder=$(mkdir -p "${1:?"name the folder that the release goes to"}" && cd "$1" && pwd)
shift
targets=("$@")
if ((${#targets[@]} == 0)); then
    targets=({x86_64,aarch64}-unknown-linux-{gnu,musl})
fi

# What wheels may ask of the system: glibc of 2014, or musl of 2021.
compatibility() {
    case "$1" in
        *-musl) echo musllinux_1_2 ;;
        *) echo manylinux2014 ;;
    esac
}

if [[ ! -x "$cache/release/bin/maturin" ]]; then
    python3 -m venv --clear "$cache/release"
    "$cache/release/bin/pip" install -q --disable-pip-version-check maturin==1.16.0 ziglang==0.15.2 cargo-zigbuild
fi
export PATH="$cache/release/bin:$PATH"
export CARGO_ZIGBUILD_PYTHON_PATH="$cache/release/bin/python"
target_folder="${CARGO_TARGET_DIR:-$root/target}"

cd "$root"
made=0
for target in "${targets[@]}"; do
    sysroot=$(rustc --print sysroot)
    if [[ ! -d "$sysroot/lib/rustlib/$target/lib" ]] && ! rustup target add "$target"; then
        echo "SKIPPED $target: Rust's own library for it cannot be had. Run: rustup target add $target"
        continue
    fi
    maturin build --release --locked --zig --target "$target" --compatibility "$(compatibility "$target")" \
        --manifest-path crates/eyebolt-py/Cargo.toml --out "$folder"
    if [[ "$target" == *-musl ]]; then
        cargo zigbuild --release --locked --target "$target" -p eyebolt-cli
        install "$target_folder/$target/release/eyebolt" "$folder/eyebolt-${target%%-*}-linux"
    fi
    made=$((made + 1))
done
((made > 0)) || { echo "nothing was made"; exit 1; }
cd "$folder"
rm -f SHA256SUMS
sums=$(sha256sum -- *)
echo "$sums" >SHA256SUMS
