#include <benchmark/benchmark.h>

#include "engine/core/blas.h"

int main(int argc, char** argv) {
  burnish::useFastestBlasKernels();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
