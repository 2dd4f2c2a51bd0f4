/// The posterior of a Kennedy-O'Hagan calibration as samplers see it: prior and
/// likelihood on the real line, with gradients, names and physical values.
/// Source: paper 1, eq. 13. It takes the Kronecker form where the runs are a grid, else
/// the dense one. Whole-number inputs are left out.
#include "emulator/density.hpp"

#include "kernel/batch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::emulator {

namespace {

Layout checked_layout(const Standardised& data, const ModelOptions& options) {
    if (!kernel::is_supported(kernel::InstructionSet::scalar))
        throw std::invalid_argument(
            "this processor has no fused multiply-add (FMA, since 2013)");
    const Layout layout =
        layout_of(options, data.data.measured_x.cols, data.data.simulated_t.cols);
    if (data.data.measured.size() < layout.n_beta_delta)
        throw std::invalid_argument(
            fmt::format("{} measurements for {} coefficients of the discrepancy's mean",
                        data.data.measured.size(), layout.n_beta_delta));
    return layout;
}

std::unique_ptr<Likelihood> make_likelihood(const Observations& data,
                                            const ModelOptions& options,
                                            const Layout& layout) {
    if (options.form == Form::kronecker_if_grid)
        if (const auto grid = find_grid(data)) return make_kronecker(*grid, data, layout);
    return make_dense(data, layout);
}

std::vector<std::string> coefficient_names(const char* of, Mean mean,
                                           const std::vector<std::string>& x) {
    std::vector<std::string> names;
    if (mean == Mean::none) return names;
    names.push_back(fmt::format("beta_{}_constant", of));
    for (std::size_t k = 0; mean == Mean::linear && k < x.size(); ++k)
        names.push_back(fmt::format("beta_{}_{}", of, x[k]));
    return names;
}

/// Of a likelihood's arguments.
std::vector<std::string> argument_names(const Layout& layout, const Observations& data) {
    std::vector<std::string> names = data.t_names;
    for (const auto* inputs : {&data.x_names, &data.t_names})
        for (const std::string& name : *inputs) names.push_back("rho_eta_" + name);
    for (const std::string& name : data.x_names) names.push_back("rho_delta_" + name);
    for (const char* name : {"lambda_eta", "lambda_delta", "lambda_e", "rho"})
        names.emplace_back(name);
    for (const auto& more :
         {coefficient_names("eta", layout.emulator_mean, data.x_names),
          coefficient_names("delta", layout.discrepancy_mean, data.x_names)})
        names.insert(names.end(), more.begin(), more.end());
    return names;
}

}  // namespace

KohDensity::KohDensity(const Standardised& data, const ModelOptions& options)
    : data_(data),
      coordinates_(checked_layout(data, options), options.priors),
      likelihood_(make_likelihood(data_.data, options, checked_layout(data, options))),
      arguments_(layout().size()),
      slopes_(dimension()),
      prior_gradient_(dimension()),
      gradient_(layout().size()) {}

void KohDensity::evaluate(const Matrix& points, bool gradients,
                          sampling::Evaluations& out) {
    out.prior.resize(points.rows);
    out.likelihood.resize(points.rows);
    if (gradients) {
        out.prior_gradient = Matrix(points.rows, dimension());
        out.likelihood_gradient = Matrix(points.rows, dimension());
    }
    for (std::size_t i = 0; i < points.rows; ++i) {
        out.prior[i] = coordinates_.place(points.row(i).data(), arguments_.data(),
                                          slopes_.data(), prior_gradient_.data());
        out.likelihood[i] = likelihood_->evaluate(arguments_.data(),
                                                  gradients ? gradient_.data() : nullptr);
        if (!gradients) continue;
        std::ranges::copy(prior_gradient_, out.prior_gradient.row(i).begin());
        if (std::isinf(out.likelihood[i])) continue;
        for (std::size_t k = 0; k < dimension(); ++k)
            out.likelihood_gradient(i, k) =
                slopes_[k] * gradient_[coordinates_.free()[k].argument];
    }
}

std::vector<double> KohDensity::draw_start(Stream& random) const {
    return coordinates_.draw(random);
}

std::vector<std::string> KohDensity::names() const {
    const std::vector<std::string> all = argument_names(layout(), data_.data);
    std::vector<std::string> names;
    names.reserve(dimension());
    for (const Coordinate& c : coordinates_.free()) names.push_back(all[c.argument]);
    return names;
}

std::vector<double> KohDensity::values(std::span<const double> point) const {
    std::vector<double> values(dimension());
    for (std::size_t k = 0; k < dimension(); ++k) {
        const Coordinate& c = coordinates_.free()[k];
        values[k] = coordinates_.value(k, point[k]);
        if (c.role == Role::t) values[k] = data_.t[c.argument].physical(values[k]);
    }
    return values;
}

}  // namespace bemcal::emulator
