# billet in a container, from the Debian packages that are built in the first stage:
#
#   docker build -t billet .
#   docker run --rm -v "$PWD:/job" billet run case.toml
#
# It runs on processors of any x86-64 level (app/processor.h). Results belong to the user who is named
# by --user "$(id -u):$(id -g)".
FROM debian:12 AS packages
COPY . /billet
RUN /billet/dev package

FROM debian:12-slim
COPY --from=packages /billet/build/package/packages /packages
RUN apt-get update \
 && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
      /packages/billet_*.deb /packages/python3-billet_*.deb /packages/billet-multigrid_*.deb openmpi-bin ffmpeg \
 && rm -rf /var/lib/apt/lists/* /packages
WORKDIR /job
ENTRYPOINT ["billet"]
CMD ["--help"]
