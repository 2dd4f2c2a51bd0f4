/// The coroutines of a call and the points that they wait for: as many as the density
/// likes are evaluated together, first come, first served, and their coroutines resumed.
#pragma once

#include "sampling/density.hpp"
#include "sampling/point.hpp"

#include <coroutine>
#include <vector>

namespace bemcal::sampling {

class Company {
  public:
    /// \param gradients  whether points are to have their gradients too
    Company(Density& density, bool gradients);

    struct Evaluation {
        Company& company;
        Point& point;
        bool await_ready() const noexcept { return false; }
        void await_suspend(std::coroutine_handle<> caller) const {
            company.waiting_.push_back({&point, caller});
        }
        void await_resume() const noexcept {}
    };
    /// `co_await company.evaluate(point)` fills all but the point's x.
    Evaluation evaluate(Point& point) { return {*this, point}; }

    /// Goes on until no point is left to evaluate.
    void run();

  private:
    struct Request {
        Point* point;
        std::coroutine_handle<> caller;
    };
    void evaluate_group();
    void answer(std::size_t row, Point& point) const;

    Density& density_;
    bool gradients_;
    std::vector<Request> waiting_, group_;
    Matrix points_;
    Evaluations values_;
};

}  // namespace bemcal::sampling
