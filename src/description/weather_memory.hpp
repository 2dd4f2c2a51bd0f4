/// Weathers of a stock, each read and its planes computed once, however many buildings
/// share it: known by what their files hold and what the job says of them, not by name.
#pragma once

#include "schema/section.hpp"
#include "study/case.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace bemcal::description {

class WeatherMemory {
  public:
    /// Into `building`: weather, sky and decisions. What `read` makes of a building that
    /// has periods and warm-up already is kept, unless it throws.
    void get(const std::string& key, study::Case& building,
             const std::function<void(study::Case&)>& read);

    /// Content of a file, "" where it cannot be read; each path is looked at once.
    std::string content_hash(const std::filesystem::path& path);

    int n_read() const { return n_read_; }

  private:
    struct Kept;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Kept>> kept_;
    std::map<std::string, std::string> hashes_;
    int n_read_ = 0;
};

/// All that a section says, but for one key; marked as if all of it had been read.
std::string text_of(const schema::Section& section, const std::string& without = "");

}  // namespace bemcal::description
