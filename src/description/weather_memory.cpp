/// Keeps the weathers of a stock: each is read once, its irradiance on planes computed
/// once, under a key of file contents and sections. Threads that want the same wait for
/// it.
/// Follows from content hashes; a path is hashed once in a run.
/// Beyond 64 weathers all are dropped. A file that changes during the run is not noticed.
#include "description/weather_memory.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "input/input_files.hpp"

#include <utility>

#include <fmt/format.h>

namespace bemcal::description {
namespace {

constexpr std::size_t most_kept = 64;

/// Irradiance on planes over the whole of a weather, as asked for.
class PlaneMemory : public physics::PlaneSource {
  public:
    explicit PlaneMemory(physics::Weather weather) : weather_(std::move(weather)) {}

    Series series(const physics::Plane& plane, physics::SkyModel sky) override {
        const std::scoped_lock lock(mutex_);
        for (const Known& known : known_)
            if (known.plane == plane && known.sky == sky) return known.series;
        known_.push_back({plane, sky,
                          std::make_shared<const std::vector<double>>(
                              physics::irradiance_series(weather_, plane, sky))});
        return known_.back().series;
    }

  private:
    struct Known {
        physics::Plane plane;
        physics::SkyModel sky;
        Series series;
    };
    physics::Weather weather_;
    std::mutex mutex_;
    std::vector<Known> known_;
};

void add_text(const schema::Node& node, std::string& text) {
    node.used = true;
    text += fmt::format("{}:{}:{};", static_cast<int>(node.kind), node.text, node.number);
    for (const schema::Entry& entry : node.entries) {
        text += entry.key + "=";
        add_text(entry.node, text);
    }
}

}  // namespace

struct WeatherMemory::Kept {
    std::mutex mutex;
    bool is_read = false;
    physics::Weather weather;
    physics::SkyModel sky = physics::SkyModel::perez;
    std::shared_ptr<physics::PlaneSource> planes;
    std::vector<study::DataDecision> decisions;
};

void WeatherMemory::get(const std::string& key, study::Case& building,
                        const std::function<void(study::Case&)>& read) {
    std::shared_ptr<Kept> kept;
    {
        const std::scoped_lock lock(mutex_);
        if (kept_.size() >= most_kept && !kept_.contains(key)) kept_.clear();
        std::shared_ptr<Kept>& place = kept_[key];
        if (!place) place = std::make_shared<Kept>();
        kept = place;
    }
    const std::scoped_lock lock(kept->mutex);
    if (!kept->is_read) {
        study::Case made = building;
        made.decisions.clear();
        read(made);
        kept->planes = std::make_shared<PlaneMemory>(made.weather);
        kept->weather = std::move(made.weather);
        kept->sky = made.sky;
        kept->decisions = std::move(made.decisions);
        kept->is_read = true;
        const std::scoped_lock count(mutex_);
        ++n_read_;
    }
    building.weather = kept->weather;
    building.sky = kept->sky;
    building.planes = kept->planes;
    building.decisions.insert(building.decisions.end(), kept->decisions.begin(),
                              kept->decisions.end());
}

std::string WeatherMemory::content_hash(const std::filesystem::path& path) {
    {
        const std::scoped_lock lock(mutex_);
        const auto known = hashes_.find(path.string());
        if (known != hashes_.end()) return known->second;
    }
    std::string hash = input::file_hash(path);
    const std::scoped_lock lock(mutex_);
    return hashes_.emplace(path.string(), std::move(hash)).first->second;
}

std::string text_of(const schema::Section& section, const std::string& without) {
    std::string text;
    for (const schema::Entry& entry : section.root().entries) {
        std::string part = entry.key + "=";
        add_text(entry.node, part);
        if (entry.key != without) text += part;
    }
    return text;
}

}  // namespace bemcal::description
