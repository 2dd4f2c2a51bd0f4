/// Evaluates a likelihood or a conditional, with a growing addition to the diagonal where
/// a covariance is not positive definite in doubles, and counts how often that was
/// needed.
/// Usual practice (jitter), without a source. With the last of four steps failed the
/// density is 0 there. The forms themselves are dense and kronecker.
#include "emulator/likelihood.hpp"

#include <limits>
#include <stdexcept>

namespace bemcal::emulator {

double Likelihood::evaluate(const double* arguments, double* gradient) {
    double value = 0;
    for (std::size_t step = 0; step < jitter_steps.size(); ++step)
        if (attempt(arguments, jitter_steps[step], gradient, value)) {
            ++jitter_.n_with[step];
            return value;
        }
    ++jitter_.n_failed;
    return -std::numeric_limits<double>::infinity();
}

CoefficientPosterior Likelihood::coefficients(const double* arguments) {
    evaluate(arguments, nullptr);
    return coefficients_;
}

Conditional Likelihood::condition(const double* arguments, const Matrix& x) {
    Conditional made;
    for (const double jitter : jitter_steps)
        if (attempt_condition(arguments, jitter, x, made)) return made;
    throw std::domain_error("the covariance of the data is not positive definite");
}

}  // namespace bemcal::emulator
