/// Where a method of optimisation waits for the values of its points.
///
/// A method is a coroutine, written as if the objectives were a function of many points
/// at once: `const Matrix values = co_await search.evaluate(positions)`. Positions that
/// were evaluated before are answered at once; the others are the batch that the
/// optimiser hands out. Objectives are minimised; one that is not finite is infinitely
/// bad. When the budget is spent or the target reached, the method is not resumed: it
/// needs no check.
#pragma once

#include "optimise/space.hpp"

#include <coroutine>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace bemcal::optimise {

struct Found {
    Position position;
    std::vector<double> objectives;
};

struct Limits {
    std::size_t evaluations = 50000;  ///< of different points; the budget
    /// The search ends where its (only) objective is at most this.
    double target = -std::numeric_limits<double>::infinity();
};

class Search {
  public:
    Search(Space space, std::size_t n_objectives, const Limits& limits);

    struct Evaluation {
        Search& search;
        std::vector<Position> positions;
        bool await_ready() const { return false; }
        void await_suspend(std::coroutine_handle<> method) const {
            search.method_ = method;
        }
        /// [positions x objectives]
        Matrix await_resume() const { return search.known(positions); }
    };
    Evaluation evaluate(std::vector<Position> positions);

    const Space& space() const { return space_; }
    std::size_t n_objectives() const { return n_objectives_; }
    std::size_t n_evaluated() const { return values_.size(); }

    /// What the method waits for; empty: it has ended.
    const std::vector<Position>& waiting_for() const { return waiting_for_; }
    /// [waiting_for x objectives]; goes on with the method until it waits again.
    void answer(const Matrix& values);
    /// Resumes the method for as long as all it asks for is known. From here, and not
    /// from within its wait, so that the stack stays as deep as it is.
    void proceed();

    /// One objective: the best point. Several: those that the method kept.
    const std::vector<Found>& found() const { return found_; }
    void keep(std::vector<Found> found) { found_ = std::move(found); }

  private:
    Matrix known(const std::vector<Position>& positions) const;
    void store(const Position& position, std::span<const double> objectives);
    bool is_over() const;

    Space space_;
    std::size_t n_objectives_;
    Limits limits_;
    std::map<Position, std::vector<double>> values_;
    std::vector<Position> waiting_for_;
    bool is_cut_ = false;  ///< the budget does not reach for the whole batch
    std::coroutine_handle<> method_;
    std::vector<Found> found_;
};

}  // namespace bemcal::optimise
