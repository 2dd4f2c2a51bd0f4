/// Lays the unknowns of several buildings into one position: the same for all, or each
/// building's own, normal around a common mean with a common spread.
/// Source: hierarchical models (Gelman et al., Bayesian Data Analysis), in centred form.
/// Leaves out correlated unknowns, and discrete ones of a building's own.
#include "posterior/arrangement.hpp"

#include "sampling/normal.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

/// Of the spread tau of a population.
constexpr double median_spread = 0.3, sd_log_spread = 0.7;

stats::Prior spread_prior() {
    return stats::lognormal_prior(median_spread, sd_log_spread);
}

class Shared : public Arrangement {
  public:
    explicit Shared(std::shared_ptr<const study::Space> space)
        : space_(std::move(space)) {}

    std::size_t dimension() const override { return space_->n_free(); }
    std::vector<int> levels() const override { return space_->levels(); }
    std::vector<char> held_in_climb() const override { return space_->sizes(); }
    double log_prior(std::span<const double> position,
                     std::span<double> gradient) const override {
        return space_->log_prior(position, gradient);
    }
    std::vector<double> draw_start(Stream& random) const override {
        return space_->draw_position(random);
    }
    void take(std::span<const double> position, std::size_t,
              std::span<double> own) const override {
        std::ranges::copy(position, own.begin());
    }
    void give(std::span<const double> own_gradient, std::size_t,
              std::span<double> gradient) const override {
        for (std::size_t f = 0; f < own_gradient.size(); ++f)
            gradient[f] += own_gradient[f];
    }
    void take_unseen(std::span<const double> position, Stream&,
                     std::span<double> own) const override {
        std::ranges::copy(position, own.begin());
    }
    std::vector<study::Coordinate> reported() const override {
        std::vector<study::Coordinate> free;
        free.reserve(space_->n_free());
        for (std::size_t f = 0; f < space_->n_free(); ++f)
            free.push_back(space_->coordinates()[space_->index_of(f)]);
        return free;
    }
    void read(std::span<const double> position, std::span<double> values) const override {
        std::vector<double> all(space_->size());
        space_->read(position, all);
        for (std::size_t f = 0; f < space_->n_free(); ++f)
            values[f] = all[space_->index_of(f)];
    }
    std::vector<std::size_t> reported_of(std::size_t) const override {
        std::vector<std::size_t> all(space_->n_free());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }

  private:
    std::shared_ptr<const study::Space> space_;
};

class Hierarchical : public Arrangement {
  public:
    Hierarchical(std::shared_ptr<const study::Space> space,
                 std::vector<std::string> buildings)
        : space_(std::move(space)), buildings_(std::move(buildings)) {
        const std::vector<int> levels = space_->levels();
        for (std::size_t f = 0; f < levels.size(); ++f)
            if (levels[f] == 0) own_.push_back(f);
    }

    std::size_t dimension() const override {
        return space_->n_free() + own_.size() * (1 + buildings_.size());
    }
    std::vector<int> levels() const override {
        std::vector<int> levels = space_->levels();
        levels.resize(dimension(), 0);
        return levels;
    }
    double log_prior(std::span<const double> position,
                     std::span<double> gradient) const override;
    std::vector<double> draw_start(Stream& random) const override;
    void take(std::span<const double> position, std::size_t building,
              std::span<double> own) const override {
        std::ranges::copy(position.first(space_->n_free()), own.begin());
        for (std::size_t k = 0; k < own_.size(); ++k)
            own[own_[k]] = position[at(building, k)];
    }
    void give(std::span<const double> own_gradient, std::size_t building,
              std::span<double> gradient) const override {
        for (std::size_t k = 0; k < own_.size(); ++k)
            gradient[at(building, k)] += own_gradient[own_[k]];
    }
    void take_unseen(std::span<const double> position, Stream& random,
                     std::span<double> own) const override {
        std::ranges::copy(position.first(space_->n_free()), own.begin());
        for (std::size_t k = 0; k < own_.size(); ++k)
            own[own_[k]] +=
                std::exp(position[spread(k)]) * sampling::standard_normal(random);
    }
    std::vector<study::Coordinate> reported() const override;
    void read(std::span<const double> position, std::span<double> values) const override;
    std::vector<std::size_t> reported_of(std::size_t building) const override {
        std::vector<std::size_t> all(space_->n_free());
        std::iota(all.begin(), all.end(), std::size_t{0});
        for (std::size_t k = 0; k < own_.size(); ++k) all[own_[k]] = at(building, k);
        return all;
    }

  private:
    std::size_t spread(std::size_t k) const { return space_->n_free() + k; }
    std::size_t at(std::size_t building, std::size_t k) const {
        return space_->n_free() + own_.size() * (1 + building) + k;
    }
    /// Log density of one building's unknown k; adds the gradient.
    double add_building(std::span<const double> position, std::size_t building,
                        std::size_t k, std::span<double> gradient) const;

    std::shared_ptr<const study::Space> space_;
    std::vector<std::string> buildings_;
    std::vector<std::size_t> own_;  ///< free numbers that buildings have of their own
};

double Hierarchical::add_building(std::span<const double> position, std::size_t building,
                                  std::size_t k, std::span<double> gradient) const {
    const double inverse = std::exp(-position[spread(k)]);
    const double z = (position[at(building, k)] - position[own_[k]]) * inverse;
    gradient[at(building, k)] -= z * inverse;
    gradient[own_[k]] += z * inverse;
    gradient[spread(k)] += z * z - 1;
    return -0.5 * z * z - position[spread(k)];
}

double Hierarchical::log_prior(std::span<const double> position,
                               std::span<double> gradient) const {
    double sum = space_->log_prior(position.first(space_->n_free()),
                                   gradient.first(space_->n_free()));
    for (std::size_t k = 0; k < own_.size(); ++k) {
        const double z = (position[spread(k)] - std::log(median_spread)) / sd_log_spread;
        sum -= 0.5 * z * z;
        gradient[spread(k)] -= z / sd_log_spread;
        for (std::size_t b = 0; b < buildings_.size(); ++b)
            sum += add_building(position, b, k, gradient);
    }
    return sum;
}

std::vector<double> Hierarchical::draw_start(Stream& random) const {
    std::vector<double> position = space_->draw_position(random);
    position.resize(dimension());
    for (std::size_t k = 0; k < own_.size(); ++k) {
        position[spread(k)] =
            std::log(median_spread) + sd_log_spread * sampling::standard_normal(random);
        for (std::size_t b = 0; b < buildings_.size(); ++b)
            position[at(b, k)] =
                position[own_[k]] +
                std::exp(position[spread(k)]) * sampling::standard_normal(random);
    }
    return position;
}

std::vector<study::Coordinate> Hierarchical::reported() const {
    std::vector<study::Coordinate> names;
    const auto coordinate = [&](std::size_t f) {
        return space_->coordinates()[space_->index_of(f)];
    };
    names.reserve(space_->n_free() + own_.size());
    for (std::size_t f = 0; f < space_->n_free(); ++f) names.push_back(coordinate(f));
    for (const std::size_t f : own_)
        names.push_back(
            {fmt::format("{}_spread", coordinate(f).name), "-", spread_prior()});
    for (const std::string& building : buildings_)
        for (const std::size_t f : own_) {
            study::Coordinate one = coordinate(f);
            one.name = fmt::format("{}_{}", one.name, building);
            names.push_back(std::move(one));
        }
    return names;
}

void Hierarchical::read(std::span<const double> position,
                        std::span<double> values) const {
    std::vector<double> own(space_->n_free()), all(space_->size());
    const auto write_free = [&](std::size_t f, std::size_t to) {
        values[to] = all[space_->index_of(f)];
    };
    space_->read(position.first(space_->n_free()), all);
    for (std::size_t f = 0; f < space_->n_free(); ++f) write_free(f, f);
    for (std::size_t k = 0; k < own_.size(); ++k)
        values[spread(k)] = std::exp(position[spread(k)]);
    for (std::size_t b = 0; b < buildings_.size(); ++b) {
        take(position, b, own);
        space_->read(own, all);
        for (std::size_t k = 0; k < own_.size(); ++k) write_free(own_[k], at(b, k));
    }
}

}  // namespace

std::unique_ptr<Arrangement> make_arrangement(Pooling pooling,
                                              std::shared_ptr<const study::Space> space,
                                              std::vector<std::string> buildings) {
    if (pooling == Pooling::partial)
        return std::make_unique<Hierarchical>(std::move(space), std::move(buildings));
    return std::make_unique<Shared>(std::move(space));
}

}  // namespace bemcal::posterior
