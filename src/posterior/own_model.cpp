/// Our own model as meters' response: a period's drive, batch and the kernel's response.
/// Follows from `kernel::Response`, which has the adjoint.
/// Whether a building has derivatives its caller asks.
#include "kernel/response.hpp"
#include "posterior/meter_response.hpp"

#include <algorithm>
#include <utility>

namespace bemcal::posterior {
namespace {

/// Four lanes at most: chains end their trajectories at different times, and of eight
/// lanes too many would wait (a posterior takes 1.8 times as long on a Zen 4).
kernel::InstructionSet set_of_chains() {
    return std::min(kernel::choose_instruction_set(), kernel::InstructionSet::v3);
}

std::vector<kernel::Channel> channels_of(const study::Case& building,
                                         std::span<const std::size_t> meters) {
    std::vector<kernel::Channel> channels;
    channels.reserve(meters.size());
    for (const std::size_t m : meters)
        channels.push_back({building.meters[m].quantity, building.meters[m].interval});
    return channels;
}

class OwnResponse : public MeterResponse {
  public:
    OwnResponse(const study::Case& building, const study::Period& period,
                std::span<const std::size_t> meters)
        : drive_(study::drive_of(building, period)),
          batch_(building.building, building.parameters, drive_, set_of_chains()),
          response_(batch_, channels_of(building, meters)) {}

    int lanes() const override { return response_.lanes(); }
    std::unique_ptr<Run> make_run() const override {
        return std::make_unique<OwnRun>(response_.make_run());
    }
    std::vector<std::string> predict(const Matrix& points, std::size_t first,
                                     std::size_t count, Run& run) const override {
        return response_.predict(points, first, count, *own(run).run);
    }
    const double* readings(const Run& run, std::size_t meter) const override {
        return response_.readings(*static_cast<const OwnRun&>(run).run, meter);
    }
    double* sensitivities(Run& run, std::size_t meter) const override {
        return response_.sensitivities(*own(run).run, meter);
    }
    void pull_back(Run& run, Matrix& gradient) const override {
        response_.pull_back(*own(run).run, gradient);
    }

  private:
    struct OwnRun : Run {
        explicit OwnRun(kernel::Response::RunPointer made) : run(std::move(made)) {}
        kernel::Response::RunPointer run;
    };
    static OwnRun& own(Run& run) { return static_cast<OwnRun&>(run); }

    physics::Drive drive_;
    kernel::Batch batch_;
    kernel::Response response_;
};

class OwnModel : public ResponseSource {
  public:
    std::unique_ptr<MeterResponse> response(
        const study::Case& building, const study::Period& period,
        std::span<const std::size_t> meters) const override {
        return std::make_unique<OwnResponse>(building, period, meters);
    }
};

}  // namespace

std::shared_ptr<const ResponseSource> own_model() {
    return std::make_shared<OwnModel>();
}

}  // namespace bemcal::posterior
