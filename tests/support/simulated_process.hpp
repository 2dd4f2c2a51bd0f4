/// A Kennedy-O'Hagan fit to runs and measurements that eq. 3-10 themselves made, of
/// unknowns drawn from their priors.
#pragma once

#include "emulator/small_study.hpp"
#include "sampling/normal.hpp"
#include "support/ranked_fit.hpp"

#include <cmath>
#include <stdexcept>

namespace bemcal::test {

class FitOfSimulatedProcess {
  public:
    FitOfSimulatedProcess(const emulator::test::StudySize& size,
                          const emulator::ModelOptions& model,
                          const sampling::SamplerOptions& sampler)
        : size_(size), model_(model), sampler_(sampler) {}

    SimulatedFit run(const DrawPlan& plan, int n_ranks) const {
        // Inputs as a study has them, on the scale 0 to 1; outputs follow.
        emulator::Standardised data =
            emulator::standardise(emulator::test::small_study(size_, plan.seed));
        const emulator::KohDensity inputs(data, model_);
        Stream random(plan.seed, 1, 0);
        const std::vector<double> truth = inputs.coordinates().draw(random);
        draw_outputs(inputs, truth, random, data.data);
        emulator::KohDensity density(data, model_);
        const Matrix draws = draws_of(density, sampler_, plan);
        return ranked(density.names(), truth, draws, n_ranks);
    }

  private:
    /// Runs and measurements, normal with the covariance that the truth gives them.
    static void draw_outputs(const emulator::KohDensity& inputs,
                             const std::vector<double>& truth, Stream& random,
                             emulator::Observations& data) {
        const emulator::Layout& layout = inputs.layout();
        std::vector<double> arguments(layout.size()), slopes(truth.size()),
            gradient(truth.size());
        inputs.coordinates().place(truth.data(), arguments.data(), slopes.data(),
                                   gradient.data());
        const emulator::test::PlainModel model{data, layout, arguments.data()};
        const auto root = root_of(model.data_covariance());
        std::vector<double> normals(root.size());
        sampling::fill_standard_normal(random, normals);
        const std::size_t m = data.simulated.size();
        for (std::size_t i = 0; i < root.size(); ++i) {
            emulator::test::Long sum = 0;
            for (std::size_t j = 0; j <= i; ++j) sum += root[i][j] * normals[j];
            (i < m ? data.simulated[i] : data.measured[i - m]) = static_cast<double>(sum);
        }
    }

    /// Cholesky's, in extended precision.
    static emulator::test::LongMatrix root_of(emulator::test::LongMatrix a) {
        for (std::size_t j = 0; j < a.size(); ++j) {
            for (std::size_t k = 0; k < j; ++k)
                for (std::size_t i = j; i < a.size(); ++i) a[i][j] -= a[i][k] * a[j][k];
            if (!(a[j][j] > 0)) throw std::domain_error("not positive definite");
            const emulator::test::Long scale = std::sqrt(a[j][j]);
            for (std::size_t i = j; i < a.size(); ++i) a[i][j] /= scale;
        }
        return a;
    }

    emulator::test::StudySize size_;
    emulator::ModelOptions model_;
    sampling::SamplerOptions sampler_;
};

}  // namespace bemcal::test
