/// The true process and new measurements at points x, from draws of the posterior: a
/// joint normal for each draw, and a draw of it.
/// Source: Kennedy and O'Hagan 2001, by conditioning. The joint covariance is made for
/// every draw, so it is for some hundred points. Which draws are taken is the caller's
/// choice.
#include "emulator/prediction.hpp"

#include "sampling/normal.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bemcal::emulator {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A draw from a normal distribution whose covariance may be singular.
std::vector<double> draw_normal(const std::vector<double>& mean, const Matrix& covariance,
                                Stream& random) {
    const auto n = static_cast<Eigen::Index>(mean.size());
    Eigen::VectorXd normals(n);
    sampling::fill_standard_normal(random, {normals.data(), mean.size()});
    const Eigen::LDLT<Eigen::MatrixXd> factor(
        Eigen::Map<const RowMajor>(covariance.values.data(), n, n));
    const Eigen::VectorXd scaled =
        factor.vectorD().cwiseMax(0).cwiseSqrt().cwiseProduct(normals);
    const Eigen::VectorXd moved =
        factor.transpositionsP().transpose() * (factor.matrixL() * scaled);
    std::vector<double> made = mean;
    for (Eigen::Index i = 0; i < n; ++i) made[static_cast<std::size_t>(i)] += moved[i];
    return made;
}

/// A likelihood's arguments, with coefficients drawn where they are integrated out.
std::vector<double> arguments_at(KohDensity& density, std::span<const double> point,
                                 Stream& random) {
    const Layout& layout = density.layout();
    std::vector<double> arguments(layout.size()), slopes(density.dimension()),
        gradient(density.dimension());
    density.coordinates().place(point.data(), arguments.data(), slopes.data(),
                                gradient.data());
    if (layout.n_beta() == 0 || layout.samples_beta) return arguments;
    const CoefficientPosterior beta = density.likelihood().coefficients(arguments.data());
    const std::vector<double> drawn = draw_normal(beta.mean, beta.covariance, random);
    std::ranges::copy(drawn,
                      arguments.begin() + static_cast<std::ptrdiff_t>(layout.beta()));
    return arguments;
}

}  // namespace

Prediction predict(KohDensity& density, const Matrix& draws, const Matrix& x,
                   Stream& random) {
    const Layout& layout = density.layout();
    const Scale& output = density.data().output;
    const Matrix points = scaled_rows(x, density.data().x);
    Prediction made{Matrix(draws.rows, x.rows), Matrix(draws.rows, x.rows),
                    Matrix(draws.rows, x.rows), Matrix(draws.rows, layout.n_beta())};
    for (std::size_t d = 0; d < draws.rows; ++d) {
        const std::vector<double> arguments = arguments_at(density, draws.row(d), random);
        std::copy_n(arguments.begin() + static_cast<std::ptrdiff_t>(layout.beta()),
                    layout.n_beta(), made.coefficients.row(d).begin());
        const Conditional process =
            density.likelihood().condition(arguments.data(), points);
        const std::vector<double> drawn =
            draw_normal(process.mean, process.covariance, random);
        const double noise = std::exp(-arguments[layout.log_lambda_e()] / 2);
        for (std::size_t i = 0; i < x.rows; ++i) {
            made.mean(d, i) = output.physical(process.mean[i]);
            made.process(d, i) = output.physical(drawn[i]);
            made.measurement(d, i) =
                output.physical(drawn[i] + noise * sampling::standard_normal(random));
        }
    }
    return made;
}

}  // namespace bemcal::emulator
