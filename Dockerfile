# After scripts/package:   docker build -t burnish .   and then   docker run --rm -v "$PWD:/work" burnish run press.yaml
FROM debian:12-slim
RUN --mount=type=bind,source=build/package,target=/packages apt-get update && apt-get install -y /packages/burnish_*.deb && rm -rf /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["burnish"]
