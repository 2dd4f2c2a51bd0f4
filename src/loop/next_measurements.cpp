/// Adds the information of each measurement to that of the readings: two models are apart
/// by the squares of their difference that parameters cannot follow, a parameter is as
/// wide as the inverse says.
/// Source: Box and Hill 1967 (discrimination among models), Chaloner and Verdinelli 1995
/// (Bayesian experimental design), both about the calibrated point.
/// The weather of the training period stands for that of the weeks to come. Left out:
/// CO2, wind, circuits and supply temperatures, which the model does not read; steps
/// below an hour; two measurements together.
#include "loop/next_measurements.hpp"

#include "base/error.hpp"
#include "loop/decisions.hpp"
#include "loop/intervals.hpp"
#include "loop/open_questions.hpp"
#include "physics/calendar.hpp"
#include "stats/distributions.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using physics::Quantity;

/// The cheapest first: no work, a logger on a shelf, a register that is read by the hour,
/// a meter that is built into pipes.
struct MeasurementKind {
    const char* name;
    std::optional<Quantity> added;  ///< nothing: only the meters that there are
};
constexpr std::array measurement_kinds = {
    MeasurementKind{"the same meters, read on", std::nullopt},
    MeasurementKind{"room temperature by the hour", Quantity::air_temperature},
    MeasurementKind{"electricity by the hour", Quantity::electricity},
    MeasurementKind{"gas by the hour", Quantity::gas},
    MeasurementKind{"district heat by the hour", Quantity::district},
    MeasurementKind{"heat meter of the rooms' heating", Quantity::heating},
    MeasurementKind{"heat meter of the rooms' cooling", Quantity::cooling},
};
constexpr int n_months = 12;  ///< each from its first day

/// In the order of Quantity.
std::vector<kernel::Channel> all_by_the_hour() {
    std::vector<kernel::Channel> all;
    for (const physics::QuantityRow& row : physics::quantity_rows)
        all.push_back({row.quantity, physics::Interval::hourly});
    return all;
}

/// Hours after each other of one channel.
struct Stretch {
    std::size_t first, n;  ///< among the readings of all
    double weight;         ///< of a squared error in -2 log likelihood
};

/// The model that stands, and others, as all channels would show them by the hour.
class Shown {
  public:
    Shown(const LoopData& data, const Place& place, const Standing& last, double misfit)
        : data_(data), place_(place), misfit_(misfit) {
        place_.channels = all_by_the_hour();
        const BuiltModel built = build(place_, last.model.effects);
        at_.x = last.fit.at.x;
        study::linearise(*built.fit_model, built.unknowns, at_);
        first_ = built.fit_model->first();
        begins_ = study::begins_of(study::axis_of(data.building, data.training()),
                                   physics::Interval::hourly);
        find_weights(last);
    }

    bool is_known() const { return !std::isnan(at_.predicted[0]); }

    /// Another model's hours less those of the one that stands; nothing where it cannot
    /// be simulated.
    std::optional<std::vector<double>> difference_to(const OtherAnswer& other) const {
        try {
            const BuiltModel built = build(place_, other.effects);
            Matrix point(1, built.unknowns.size());
            for (std::size_t k = 0; k < point.cols; ++k)
                point(0, k) = built.unknowns[k].within(other.x[k]);
            std::vector<double> moved = built.fit_model->predict(point).values;
            if (std::isnan(moved[0])) return std::nullopt;
            for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= at_.predicted[i];
            return moved;
        } catch (const CannotSimulate&) {
            return std::nullopt;
        }
    }

    /// Whether the model has it and nobody reads it by the hour.
    bool is_new(Quantity quantity) const {
        const auto c = static_cast<std::size_t>(quantity);
        const auto own = hours(c, at_.predicted);
        return !is_read_[c] && std::ranges::any_of(own, [](double v) { return v != 0; });
    }

    /// The hours of so many weeks from the first day of a month; nothing where training
    /// lacks them.
    std::vector<Stretch> stretches(const MeasurementKind& kind, int month,
                                   int weeks) const {
        const auto n = static_cast<std::size_t>(weeks) * 7 * 24;
        const auto from = first_hour_of(month, n);
        std::vector<Stretch> all;
        if (!from) return all;
        for (std::size_t c = 0; c < is_read_.size(); ++c) {
            const bool is_added =
                kind.added && c == static_cast<std::size_t>(*kind.added);
            if (is_read_[c] || is_added)
                all.push_back({first_[c] + *from, n,
                               is_read_[c] ? weights_[c] : weight_of_new(c, *from, n)});
        }
        return all;
    }

    Matrix derivatives(const Stretch& stretch) const {
        Matrix part(at_.derivatives.rows, stretch.n);
        for (std::size_t p = 0; p < part.rows; ++p)
            std::ranges::copy(at_.derivatives.row(p).subspan(stretch.first, stretch.n),
                              part.row(p).begin());
        return part;
    }

  private:
    std::span<const double> hours(std::size_t channel,
                                  std::span<const double> all) const {
        return all.subspan(first_[channel], first_[channel + 1] - first_[channel]);
    }

    void find_weights(const Standing& last) {
        is_read_.assign(place_.channels.size(), false);
        weights_.assign(place_.channels.size(), 0);
        for (std::size_t c = 0; c < data_.targets.n_channels(); ++c) {
            const kernel::Channel& channel = data_.targets.channels[c];
            if (!physics::is_temperature(channel.quantity))
                largest_ = std::max(largest_, mean_of(channel.quantity));
            if (channel.interval != physics::Interval::hourly) continue;
            const auto at = static_cast<std::size_t>(channel.quantity);
            is_read_[at] = true;
            weights_[at] = last.noise[c].weight() / misfit_;
            kappa_ = last.noise[c].kappa;
        }
    }

    double mean_of(Quantity quantity) const {
        return mean_of(hours(static_cast<std::size_t>(quantity), at_.predicted));
    }
    static double mean_of(std::span<const double> values) {
        double sum = 0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    }

    /// Of what nobody has read yet: its errors are those of the weeks in which it is
    /// read.
    double weight_of_new(std::size_t channel, std::size_t from, std::size_t n) const {
        double error = decisions::error_of_room, share = 1;
        if (!physics::is_temperature(place_.channels[channel].quantity)) {
            const double mean =
                mean_of(std::span(at_.predicted).subspan(first_[channel] + from, n));
            error = decisions::error_of_energy * mean;
            share = share_of_meter(mean, std::max(mean, largest_));
        }
        return error > 0 ? share / (error * error * kappa_ * misfit_) : 0;
    }

    std::optional<std::size_t> first_hour_of(int month, std::size_t n) const {
        for (std::size_t k = 0; k + n <= begins_.size(); ++k) {
            const physics::CalendarStep step = physics::calendar_step(begins_[k]);
            if (step.month == month && step.day == 1) return k;
        }
        return std::nullopt;
    }

    const LoopData& data_;
    Place place_;
    double misfit_;
    study::Linearised at_;
    std::vector<std::size_t> first_;  ///< [channels + 1]
    std::vector<physics::Seconds> begins_;
    std::vector<bool> is_read_;    ///< [quantities] by the hour
    std::vector<double> weights_;  ///< [quantities] of those that are read
    double kappa_ = 1;             ///< of what is read by the hour
    double largest_ = 0;           ///< mean of the largest meter [kWh in an hour]
};

/// What is known of the unknowns, with a measurement or without.
class Knowledge {
  public:
    Knowledge(const LoopData& data, const Standing& last, double misfit)
        : diagonal_(study::prior_diagonal(last.built.unknowns)),
          none_(diagonal_.size(), 0),
          information_(information_of(data, last, misfit)) {
        for (double& entry : diagonal_) entry += 1e-6;
    }

    void add(const Matrix& derivatives, const Stretch& stretch) {
        const std::vector<double> zero(stretch.n, 0.0),
            weights(stretch.n, stretch.weight);
        const Matrix more = stats::normal_equations(derivatives, zero, weights).matrix;
        for (std::size_t k = 0; k < more.values.size(); ++k)
            information_.values[k] += more.values[k];
    }

    /// [unknowns] in prior standard deviations
    std::vector<double> deviations() const {
        const Matrix covariance = stats::inverse(information_, diagonal_, none_);
        std::vector<double> sds;
        sds.reserve(covariance.rows);
        for (std::size_t k = 0; k < covariance.rows; ++k)
            sds.push_back(std::sqrt(std::max(0.0, covariance(k, k))));
        return sds;
    }

    /// Of squares and products of a difference: what the unknowns cannot follow.
    double not_followed(double squares, std::span<const double> with_unknowns) const {
        const auto by = stats::solve(information_, diagonal_, with_unknowns, none_);
        for (std::size_t k = 0; k < by.size(); ++k) squares -= by[k] * with_unknowns[k];
        return std::max(0.0, squares);
    }

  private:
    std::vector<double> diagonal_;
    std::vector<char> none_;
    Matrix information_;
};

struct NameQuestion {
    OtherAnswer other;
    std::vector<double> difference;  ///< [channels' hours]
};

/// All that is open, asked of one measurement after the other.
class Questions {
  public:
    Questions(const LoopData& data, const Standing& last, double misfit,
              std::vector<NameQuestion> names)
        : last_(last), names_(std::move(names)), today_(data, last, misfit) {
        sds_ = today_.deviations();
        wide_ = wide_parameters(data, last, sds_);
    }

    bool is_empty() const { return names_.empty() && wide_.empty(); }

    /// Of each question, in their order.
    std::vector<Answer> answers(const Shown& shown,
                                const std::vector<Stretch>& stretches) const {
        Knowledge then = today_;
        std::vector<double> squares(names_.size(), 0.0);
        std::vector<std::vector<double>> products(names_.size(),
                                                  std::vector<double>(sds_.size(), 0.0));
        for (const Stretch& stretch : stretches) {
            const Matrix derivatives = shown.derivatives(stretch);
            then.add(derivatives, stretch);
            const std::vector<double> weights(stretch.n, stretch.weight);
            for (std::size_t q = 0; q < names_.size(); ++q) {
                const auto own =
                    std::span(names_[q].difference).subspan(stretch.first, stretch.n);
                const auto sums = stats::bordered(derivatives, own, own, weights);
                squares[q] += sums.with_itself;
                for (std::size_t k = 0; k < sds_.size(); ++k)
                    products[q][k] += sums.with_others[k];
            }
        }
        std::vector<Answer> all;
        for (std::size_t q = 0; q < names_.size(); ++q) {
            const OtherAnswer& other = names_[q].other;
            all.push_back({other.question, "name", "", "", 0,
                           chance_to_tell(other.evidence, 0),
                           chance_to_tell(other.evidence,
                                          then.not_followed(squares[q], products[q])),
                           0});
        }
        const auto sds = then.deviations();
        for (const std::size_t k : wide_)
            all.push_back({last_.built.unknowns[k].name, "parameter", "", "", 0, sds_[k],
                           sds[k], 0});
        return all;
    }

  private:
    const Standing& last_;
    std::vector<NameQuestion> names_;
    Knowledge today_;
    std::vector<double> sds_;
    std::vector<std::size_t> wide_;
};

bool is_better(const Answer& one, const Answer& other) {
    return one.kind == "name" ? one.then > other.then : one.then < other.then;
}

bool is_enough(const Answer& answer) {
    return answer.kind == "name" ? answer.then >= decisions::enough_chance
                                 : answer.then <= decisions::enough_narrower * answer.now;
}

/// The weeks of a kind at the time of the year at which they tell most. [questions]
std::vector<Answer> best_of_year(const Questions& questions, const Shown& shown,
                                 const MeasurementKind& kind, int weeks) {
    std::vector<Answer> best;
    for (int month = 1; month <= n_months; ++month) {
        const auto stretches = shown.stretches(kind, month, weeks);
        if (stretches.empty()) continue;
        auto all = questions.answers(shown, stretches);
        for (std::size_t q = 0; q < all.size(); ++q) {
            all[q].measure = kind.name;
            all[q].from = fmt::format("1 {}", physics::name_of_month(month));
            all[q].weeks = weeks;
            if (best.size() <= q)
                best.push_back(all[q]);
            else if (is_better(all[q], best[q]))
                best[q] = all[q];
        }
    }
    return best;
}

bool is_worth_it(const Answer& answer) {
    const bool is_name = answer.kind == "name";
    const double now = is_name ? 1 - answer.now : answer.now,
                 then = is_name ? 1 - answer.then : answer.then;
    return then <= (1 - decisions::least_fall_of_doubt) * now;
}

}  // namespace

bool is_told(const std::string& kind, double now) {
    return kind == "name" && now >= decisions::enough_chance;
}

void advise(std::vector<Answer>& of_one) {
    if (of_one.empty() || is_told(of_one.front().kind, of_one.front().now)) return;
    auto chosen = std::ranges::find_if(of_one, is_enough);
    if (chosen == of_one.end()) chosen = std::ranges::min_element(of_one, is_better);
    if (is_worth_it(*chosen)) chosen->is_advised = 1;
}

double chance_to_tell(double so_far, double apart) {
    const double is_first = 1 / (1 + std::exp(-0.5 * so_far));
    if (!(apart > 0)) return std::max(is_first, 1 - is_first);
    // What the readings bring to the right one has mean `apart` and variance 4 `apart`.
    const double sd = 2 * std::sqrt(apart);
    return is_first * stats::normal_cdf((apart + so_far) / sd) +
           (1 - is_first) * stats::normal_cdf((apart - so_far) / sd);
}

std::vector<Answer> next_measurements(const LoopData& data, const Place& place,
                                      const Standing& last,
                                      const std::vector<Found>& found, double misfit) {
    const Shown shown(data, place, last, misfit);
    if (!shown.is_known()) return {};
    std::vector<NameQuestion> names;
    for (OtherAnswer& other : other_answers(data, place, last, found))
        if (auto difference = shown.difference_to(other)) {
            other.evidence /= misfit;
            names.push_back({std::move(other), std::move(*difference)});
        }
    const Questions questions(data, last, misfit, std::move(names));
    if (questions.is_empty()) return {};
    std::vector<std::vector<Answer>> by_question;
    for (const MeasurementKind& kind : measurement_kinds) {
        if (kind.added && !shown.is_new(*kind.added)) continue;
        for (const int weeks : decisions::weeks_tried) {
            const auto best = best_of_year(questions, shown, kind, weeks);
            by_question.resize(std::max(by_question.size(), best.size()));
            for (std::size_t q = 0; q < best.size(); ++q)
                by_question[q].push_back(best[q]);
        }
    }
    std::vector<Answer> all;
    for (std::vector<Answer>& of_one : by_question) {
        advise(of_one);
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

}  // namespace bemcal::loop
