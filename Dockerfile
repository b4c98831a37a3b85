# The project with all that its workflow needs, OpenFOAM too (v1912, of Debian 12).
# docs/deploy.md says how to build and use it.
FROM debian:bookworm-slim

# Of OpenFOAM's package without what it recommends: its examples.
RUN echo 'APT::Install-Recommends "false";' >/etc/apt/apt.conf.d/no-recommends \
    && apt-get update \
    && apt-get install --yes ca-certificates git make python3 python3-venv \
    && rm -rf /var/lib/apt/lists/*

# The history comes along, so that results say which commit made them.
WORKDIR /opt/equisection
COPY . .
RUN git config --system --add safe.directory /opt/equisection \
    && PIP_NO_CACHE_DIR=1 make openfoam \
    && rm -rf /var/lib/apt/lists/*

# The clone is only read; who runs the image may have no home.
ENV PATH=/opt/equisection/.venv/bin:$PATH \
    PYTHONDONTWRITEBYTECODE=1 \
    MPLCONFIGDIR=/tmp/matplotlib \
    XDG_CACHE_HOME=/tmp/cache
WORKDIR /study
CMD ["equisection", "--help"]
