# After scripts/package:   docker build -t burnish .   and then   docker run --rm -u $(id -u):$(id -g) -v "$PWD:/work" burnish run press.yaml
FROM debian:12-slim
RUN --mount=type=bind,source=build/package,target=/packages apt-get update && apt-get install -y /packages/burnish_*.deb /packages/burnish-cad_*.deb && rm -rf /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["burnish"]
