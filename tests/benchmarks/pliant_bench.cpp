/// `pliant-bench AREA [--json FILE]`: measures and prints one area of the core.
#include "tests/benchmarks/bench_cloth.hpp"
#include "tests/benchmarks/bench_design.hpp"
#include "tests/benchmarks/bench_harmonic.hpp"
#include "tests/benchmarks/bench_interlock.hpp"
#include "tests/benchmarks/bench_macro.hpp"
#include "tests/benchmarks/bench_program.hpp"

int main(int argc, char** argv) {
  return pliant::bench::runBenchmark(argc, argv,
                                     {{"cloth", pliant::bench::measureCloth},
                                      {"design", pliant::bench::measureDesign},
                                      {"harmonic", pliant::bench::measureHarmonic},
                                      {"interlock", pliant::bench::measureInterlock},
                                      {"macro", pliant::bench::measureMacro}});
}
