/// Runs points of a command, each in a folder of its own.
#pragma once

#include "external/command_options.hpp"
#include "external/handed_file.hpp"
#include "external/process.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::external {

class PointRunner {
  public:
    explicit PointRunner(CommandOptions options);
    /// The folder of the points' folders goes if none of them stayed.
    ~PointRunner();
    PointRunner(const PointRunner&) = delete;
    PointRunner& operator=(const PointRunner&) = delete;

    const CommandOptions& options() const { return options_; }

    /// Reads what the command wrote. \return why there is nothing, or ""
    using Read = std::function<std::string(const std::filesystem::path& folder)>;

    /// \return why it failed, or ""
    std::string run(std::span<const double> point, const Handed& handed,
                    const Read& read) const;

  private:
    std::string run_in(const std::filesystem::path& folder, std::span<const double> point,
                       const Handed& handed, const Read& read) const;
    void prepare(const std::filesystem::path& folder, std::span<const double> point,
                 const Handed& handed) const;
    Command command_of(const std::filesystem::path& folder,
                       std::span<const double> point) const;

    CommandOptions options_;
    std::vector<std::string> environment_;
};

}  // namespace bemcal::external
