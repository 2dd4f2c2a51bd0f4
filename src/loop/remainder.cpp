/// Lays the readings out, scans every pair's columns, and turns what the joint model
/// finds into functions. Source: `functions::search_functions`. Readings have the weights
/// of the loop's fits.
#include "loop/remainder.hpp"

#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace bemcal::loop {
namespace {

using Series = std::vector<double>;

double root_mean_square(const Series& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

Series deviations_at_points(const functions::Basis& basis,
                            const Eigen::MatrixXd& covariance) {
    Series deviations;
    for (std::size_t p = 0; p < basis.at_points.rows; ++p) {
        const auto row = basis.at_points.row(p);
        const Eigen::Map<const Eigen::VectorXd> columns(row.data(),
                                                        static_cast<long>(row.size()));
        deviations.push_back(std::sqrt(columns.dot(covariance * columns)));
    }
    return deviations;
}

}  // namespace

ReadingLayout::ReadingLayout(const LoopData& data, const std::vector<ChannelNoise>& noise)
    : data_(data), per_deviation_(weights_of(data.targets, noise)) {
    for (double& weight : per_deviation_) weight = std::sqrt(weight);
    const physics::TimeAxis axis = data.drive->period();
    const study::Targets& targets = data.targets;
    for (std::size_t c = 0; c < targets.n_channels(); ++c)
        bounds_.push_back(physics::interval_bounds(axis, targets.channels[c].interval));
    for (const double value : targets.measured)
        is_read_.push_back(std::isnan(value) ? 0 : 1);
    sort_into_blocks();
}

Series ReadingLayout::readings_of(const Matrix& shown, std::size_t first_row,
                                  std::size_t stride) const {
    Series readings;
    readings.reserve(data_.targets.size());
    for (std::size_t c = 0; c < data_.targets.n_channels(); ++c) {
        const auto row = shown.row(first_row + c * stride);
        const Series own = physics::aggregate({row.begin(), row.end()}, bounds_[c],
                                              data_.targets.channels[c].quantity);
        readings.insert(readings.end(), own.begin(), own.end());
    }
    for (std::size_t k = 0; k < readings.size(); ++k)
        if (is_read_[k] == 0) readings[k] = 0;
    return readings;
}

void ReadingLayout::write(std::span<const double> readings,
                          Eigen::Ref<Eigen::VectorXf> to) const {
    for (std::size_t k = 0; k < order_.size(); ++k)
        to[static_cast<long>(k)] =
            static_cast<float>(readings[order_[k]] * per_deviation_[order_[k]]);
}

void ReadingLayout::sort_into_blocks() {
    std::map<int, std::vector<std::size_t>> blocks;
    for (std::size_t k = 0; k < is_read_.size(); ++k)
        if (is_read_[k] != 0) blocks[data_.blocks[k]].push_back(k);
    first_row_ = {0};
    for (const auto& [block, readings] : blocks) {
        order_.insert(order_.end(), readings.begin(), readings.end());
        first_row_.push_back(static_cast<long>(order_.size()));
        fold_.push_back(static_cast<std::size_t>(block) % decisions::function_folds);
    }
}

Remainder::Remainder(const LoopData& data, const Place& place, const Standing& standing,
                     const effects::FunctionDrivers& drivers,
                     const std::vector<FoundFunction>& there,
                     const std::vector<ChannelNoise>& noise, std::optional<double> day)
    : standing_(standing),
      layout_(data, noise),
      linear_(linear_model(data, place, standing)),
      bases_(bases_of(drivers, *place.drive, day)),
      without_functions_(standing.residuals) {
    for (const functions::Basis& basis : bases_)
        inputs_.push_back(functions::columns_of(
            basis, of_period(drivers.at(basis.driver), *place.drive)));
    // What effects bring is theirs: functions take what is left.
    const std::size_t first = standing.built.first_effect(),
                      last = first + standing.model.effects.size();
    for (std::size_t k = 0; k < standing.built.unknowns.size(); ++k)
        if (standing.fit.bound[k] == 0 && (k < first || k >= last)) free_.push_back(k);
    for (const FoundFunction& function : there) {
        const auto id = id_of(function);
        if (!id) continue;
        add(*id, function, without_functions_);
        there_.push_back({*id, function.variance, function.scatter});
    }
}

functions::Path Remainder::search() const {
    return functions::search_functions(
        weighed_data(), pairs(), [&](std::size_t id) { return columns_of(id); }, there_);
}

std::vector<FoundFunction> Remainder::found_by(const functions::JointFit& fit) const {
    std::vector<FoundFunction> all;
    all.reserve(fit.functions.size());
    for (const functions::FunctionFit& function : fit.functions)
        all.push_back(found_of(function));
    return all;
}

FoundFunction Remainder::found_of(const functions::FunctionFit& fit) const {
    FoundFunction found{hook_of(fit.id), basis_of(fit.id), {},         0,
                        fit.evidence,    fit.variance,     fit.scatter};
    found.mean.assign(fit.mean.begin(), fit.mean.end());
    found.size = found.at.typical * root_mean_square(input_of(fit.id, found.mean).values);
    found.deviations = deviations_at_points(found.basis, fit.covariance);
    return found;
}

Series Remainder::moves_of(const functions::JointFit& fit) const {
    Series moves(standing_.fit.at.x.size(), 0.0);
    for (std::size_t k = 0; k < free_.size(); ++k)
        moves[free_[k]] = fit.parameters[static_cast<long>(k)];
    return moves;
}

std::optional<std::size_t> Remainder::id_of(const FoundFunction& function) const {
    for (std::size_t id = 0; id < n_pairs(); ++id)
        if (hook_of(id).name == function.at.name &&
            basis_of(id).driver == function.basis.driver)
            return id;
    return std::nullopt;
}

void Remainder::add(std::size_t id, const FoundFunction& function,
                    Series& readings) const {
    const Matrix shown =
        functions::scan(linear_.steps, id / bases_.size(), input_of(id, function.mean));
    const Series own = layout_.readings_of(shown, 0, 1);
    for (std::size_t i = 0; i < own.size(); ++i) readings[i] += own[i];
}

namespace {

bool is_from_a_day(const functions::Basis& basis) {
    return basis.points.kind == functions::Points::Kind::hours_from;
}

}  // namespace

/// Loads are followed behind them. Use alone has other hours from a day on: what acts in
/// a season does not tell its day from the season's beginning.
bool Remainder::may_pair(std::size_t id) const {
    const effects::Hook hook = hook_of(id).hook;
    if (is_from_a_day(basis_of(id))) return effects::is_use(hook);
    return !effects::follows_loads(basis_of(id).driver) || effects::leaves_loads(hook);
}

double Remainder::log_odds_of(std::size_t id) const {
    return (effects::is_at_a_meter(hook_of(id).hook) ? decisions::log_odds_of_meter
                                                     : decisions::log_odds_of_hook) +
           (is_from_a_day(basis_of(id)) ? decisions::log_odds_of_day : 0);
}

std::vector<functions::Pair> Remainder::pairs() const {
    std::vector<functions::Pair> pairs;
    pairs.reserve(n_pairs());
    for (std::size_t id = 0; id < n_pairs(); ++id)
        if (may_pair(id)) pairs.push_back({id, log_odds_of(id)});
    return pairs;
}

functions::WeighedData Remainder::weighed_data() const {
    functions::WeighedData weighed;
    weighed.first_row = layout_.first_row();
    weighed.fold = layout_.fold();
    weighed.residual.resize(layout_.n_rows());
    layout_.write(without_functions_, weighed.residual);
    weighed.left.resize(layout_.n_rows());
    layout_.write(standing_.residuals, weighed.left);
    weighed.linear_range = decisions::linear_range;
    const auto n = static_cast<long>(free_.size());
    weighed.parameters.resize(layout_.n_rows(), n);
    weighed.precision.resize(n);
    weighed.at.resize(n);
    for (long k = 0; k < n; ++k) {
        const std::size_t own = free_[static_cast<std::size_t>(k)];
        const auto row = standing_.fit.at.derivatives.row(own);
        layout_.write(row, weighed.parameters.col(k));
        weighed.precision[k] = standing_.built.unknowns[own].has_prior ? 1 : 0;
        weighed.at[k] = standing_.fit.at.x[own];
    }
    return weighed;
}

Eigen::MatrixXf Remainder::columns_of(std::size_t id) const {
    const Matrix& inputs = inputs_[id % bases_.size()];
    const Matrix shown = functions::scan(linear_.steps, id / bases_.size(), inputs);
    Eigen::MatrixXf columns(layout_.n_rows(), static_cast<long>(inputs.cols));
    for (std::size_t f = 0; f < inputs.cols; ++f)
        layout_.write(layout_.readings_of(shown, f, inputs.cols),
                      columns.col(static_cast<long>(f)));
    return columns;
}

Matrix Remainder::input_of(std::size_t id, const Series& coefficients) const {
    const Matrix& columns = inputs_[id % bases_.size()];
    Matrix input(columns.rows, 1);
    for (std::size_t t = 0; t < columns.rows; ++t)
        for (std::size_t c = 0; c < columns.cols; ++c)
            input(t, 0) += columns(t, c) * coefficients[c];
    return input;
}

}  // namespace bemcal::loop
