#!/usr/bin/env bash
# Builds the wheel, installs it where nothing of the checkout is, and tests it there.
#
#   python/wheel.sh [--build-only] [--profile dev] FOLDER      FOLDER: where the wheel goes
#
# The profile is that of cargo: release is what people install; dev is optimised less and has what other tests built.
#
#   EYEBOLT_CI_CACHE    where Python's packages stay from one run to the next
#   CARGO_TARGET_DIR    where the build stays
#   EYEBOLT_SHARED      folder of shared data; tests that need it skip without
#
# Says SKIPPED where Python's packages cannot be had.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cache="${EYEBOLT_CI_CACHE:-$HOME/.cache/eyebolt-ci}/python"
tools=(maturin==1.16.0)
tests=(-r "$root/python/tests/requirements.txt")

build_only=0
profile=release
while [[ "${1:-}" == --* ]]; do
    case $1 in
        --build-only) build_only=1 ;;
        --profile) profile=${2:?"name a profile of cargo: dev or release"} && shift ;;
        *) echo "$1 is not known: see the head of this file" && exit 2 ;;
    esac
    shift
done
wheels=${1:?"name the folder that the wheel goes to"}

# A venv at $1 with the packages that follow; kept by their names, and by what the files say that they are in.
venv() {
    local place=$1 marker
    shift
    marker="$place/$( (echo "$@"; cat "$root/python/tests/requirements.txt"; python3 --version) | sha256sum | cut -c 1-16)"
    if [[ ! -e "$marker" ]]; then
        python3 -m venv --clear "$place" && "$place/bin/pip" install -q --disable-pip-version-check "$@" || return 1
        touch "$marker"
    fi
}

if ! venv "$cache/tools" "${tools[@]}"; then
    echo "SKIPPED: no ${tools[*]} to build the wheel with"
    exit 0
fi
mkdir -p "$wheels"
# Only the wheel that is built now.
rm -f "$wheels"/eyebolt-*.whl
"$cache/tools/bin/maturin" build --profile "$profile" --locked --manifest-path "$root/crates/eyebolt-py/Cargo.toml" --out "$wheels"
if ((build_only)); then exit 0; fi

if ! venv "$cache/tests" "${tests[@]}"; then
    echo "SKIPPED: no packages to test the wheel with"
    exit 0
fi
python="$cache/tests/bin/python"
"$python" -m pip install -q --disable-pip-version-check --force-reinstall --no-deps "$wheels"/eyebolt-*.whl
export PATH="$cache/tests/bin:$PATH"

# Away from the checkout, whose folders would come before what is installed.
cd "$wheels"
eyebolt --version
# The oldest Python that the package runs on; tests, by what they are run with.
"$python" -m mypy --strict --cache-dir "$cache/mypy" --python-version 3.9 "$root/python/src/eyebolt"
MYPYPATH="$root/python" "$python" -m mypy --strict --cache-dir "$cache/mypy" "$root/python/tests"
"$python" -m mypy.stubtest --mypy-config-file "$root/pyproject.toml" eyebolt._native
"$python" -m pytest -p no:cacheprovider --rootdir "$root" "$root/python/tests"

# Rerun wants a newer NumPy than the oldest that eyebolt works with, which the other tests have.
if ! venv "$cache/rerun" pytest==8.4.2 rerun-sdk==0.41.0 mcap==1.6.0 mcap-ros2-support==0.6.0; then
    echo "SKIPPED: no Rerun to test \`Calibration.rerun\` with"
    exit 0
fi
"$cache/rerun/bin/python" -m pip install -q --disable-pip-version-check --force-reinstall --no-deps "$wheels"/eyebolt-*.whl
"$cache/rerun/bin/python" -m pytest -p no:cacheprovider --rootdir "$root" "$root/python/tests/test_rerun.py"
