// Prints the relative error of the mobility w, over decades of omega h, of this engine, of the source's
// formula, of the plain difference 1 + e - A, and of the source's Taylor expansion, against 100-digit
// arithmetic. Markdown, to standard output.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "jawari/detail/step_coefficients.h"
#include "rivals.h"
#include "support/high_precision.h"

namespace {

using jawari::test::Definition;
using jawari::test::Real;

struct WorstErrors {
    double conditioning = 0;  ///< 3.5 roundings of the sine's argument to double, amplified
    double engine = 0;
    double engine_beyond = 0;  ///< engine, less what a condition above 2 costs
    double source = 0;
    double difference = 0;
    double taylor = 0;
};

double relative_error(double value, const Real& truth) {
    return static_cast<double>(abs((Real(value) - truth) / truth));
}

/// A rival's overflow or division by zero counts as an infinite error.
void raise(double& worst, double error) {
    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
}

void measure(WorstErrors& worst, double omega, double sigma, double h) {
    const Definition truth = jawari::test::definition_of(omega, sigma, h);
    const double condition = std::abs(static_cast<double>(truth.argument_condition));
    // The engine works in long double, rivals in double.
    const double roundings = 3.5 * static_cast<double>(std::numeric_limits<long double>::epsilon() / 2);
    const double roundings_of_double = 3.5 * 0x1p-53;
    const double engine = relative_error(jawari::exact_step(omega, sigma, h).mobility, truth.w);
    raise(worst.conditioning, roundings_of_double * condition);
    raise(worst.engine, engine);
    raise(worst.engine_beyond, std::max(0.0, engine - roundings * std::max(0.0, condition - 2)));
    raise(worst.source, relative_error(jawari::rivals::mobility_by_source(omega, sigma, h), truth.w));
    raise(worst.difference, relative_error(jawari::rivals::mobility_by_difference(omega, sigma, h), truth.w));
    raise(worst.taylor, relative_error(jawari::rivals::mobility_by_taylor(omega, sigma, h), truth.w));
}

WorstErrors worst_of_decade(int decade, bool overdamped) {
    constexpr int samples = 1500;
    std::mt19937_64 generator(static_cast<unsigned>(decade + 100) * 2 + (overdamped ? 1 : 0));
    std::uniform_real_distribution<double> uniform(0, 1);
    WorstErrors worst;
    for (int i = 0; i < samples; ++i) {
        const double h = std::pow(10.0, -7 + 3 * uniform(generator));
        const double omega = std::pow(10.0, decade + uniform(generator)) / h;
        const double exponent = uniform(generator);
        double ratio = overdamped ? std::pow(10.0, 6 * exponent) : std::pow(10.0, -8 * exponent);
        if (!overdamped && i % 4 == 0) ratio = 0;
        measure(worst, omega, omega * ratio, h);
    }
    return worst;
}

void print_row(int decade, bool overdamped) {
    const WorstErrors worst = worst_of_decade(decade, overdamped);
    std::printf("| 1e%d to 1e%d | %s | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n", decade, decade + 1,
                overdamped ? "1 to 1e6" : "0 to 1", worst.engine, worst.engine_beyond, worst.conditioning,
                worst.source, worst.difference, worst.taylor);
}

}  // namespace

int main() {
    std::printf(
        "| omega h | sigma/omega | engine | engine, beyond conditioning | conditioning of the sine in double "
        "| "
        "source's formula | 1 + e - A | Taylor, order 7 |\n|---|---|---|---|---|---|---|---|\n");
    for (const bool overdamped : {false, true}) {
        for (int decade = -9; decade < 3; ++decade) print_row(decade, overdamped);
    }
    return 0;
}
