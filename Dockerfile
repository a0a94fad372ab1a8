# The program and the Python package, with nothing else in it:
#
#   docker build -t eyebolt .
#   docker run --rm -v "$PWD:/data" --user "$(id -u):$(id -g)" eyebolt calibrate /data/my_bag -o /data/calibration.json

FROM rust:1.95-slim-bookworm AS build
RUN apt-get update && apt-get install -y --no-install-recommends gcc libc6-dev python3-venv \
    && rm -rf /var/lib/apt/lists/* \
    && python3 -m venv /tools && /tools/bin/pip install --no-cache-dir maturin==1.16.0
COPY . /eyebolt
WORKDIR /eyebolt
RUN /tools/bin/maturin build --release --locked --manifest-path crates/eyebolt-py/Cargo.toml --out /wheels

FROM python:3.12-slim-bookworm
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir /wheels/*.whl && rm -r /wheels \
    && useradd --create-home --uid 1000 eyebolt
USER eyebolt
WORKDIR /data
ENTRYPOINT ["eyebolt"]
CMD ["--help"]
