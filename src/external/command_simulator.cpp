/// A point by another program: a folder, filled templates, links, the command, and the
/// numbers read from what it wrote. Whatever goes wrong is the point's reason.
/// Plain handling of files, without a source. Points are not cached and not tried again
/// here; processes are process's, numbers output_rule's.
#include "external/command_simulator.hpp"

#include "base/hash.hpp"
#include "base/nan.hpp"
#include "external/process.hpp"
#include "external/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;

/// Something went wrong with one point; what() is its reason.
struct PointFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string name_of_point(std::span<const double> point) {
    Hasher hasher;
    hasher.add(point);
    return "point-" + hasher.hex().substr(0, 16);
}

/// A folder that was not there before; an earlier run may have left one of that name, and
/// another thread may have the same point.
fs::path make_folder(const fs::path& parent, const std::string& name) {
    std::error_code error;
    fs::create_directories(parent, error);
    for (int number = 1; number < 1000000; ++number) {
        const fs::path folder =
            parent / (number == 1 ? name : fmt::format("{}-{}", name, number));
        if (fs::create_directory(folder, error)) return folder;
        if (error) break;
    }
    throw PointFailure(fmt::format("its folder cannot be made: {}",
                                   error ? error.message() : "too many of its name"));
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text << std::flush;
    if (!out)
        throw PointFailure(fmt::format("{} cannot be written: {}",
                                       file.filename().string(), std::strerror(errno)));
}

void link_file(const fs::path& from, const fs::path& folder) {
    std::error_code error;
    fs::create_symlink(from, folder / from.filename(), error);
    if (error)
        throw PointFailure(fmt::format("{} cannot be linked: {}",
                                       from.filename().string(), error.message()));
}

std::string without(std::string text, const std::string& part) {
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part))
        text.erase(at, part.size());
    return text;
}

/// The last line that says something, without the folder's own name, so that a reason is
/// the same wherever the point ran; of plain characters, at most 200.
std::string last_line(const fs::path& folder, const char* file) {
    std::istringstream in(end_of_file(folder / file, 10000));
    std::string line, last;
    while (std::getline(in, line))
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    last = without(last, fs::absolute(folder).string() + "/");
    last.resize(std::min<std::size_t>(last.size(), 200));
    for (char& c : last)
        if (c < ' ' || c > '~') c = c == '\r' || c == '\t' ? ' ' : '?';
    return last;
}

std::string how(const Ended& ended, const CommandOptions& options) {
    switch (ended.how) {
        case Ending::exited:
            return fmt::format("exit code {}", ended.number);
        case Ending::killed:
            if (ended.number == SIGXFSZ)
                return fmt::format("ended as a file reached output_limit = {:g} MB",
                                   options.output_limit / 1e6);
            return fmt::format("ended by signal {} ({})", ended.number,
                               strsignal(ended.number));
        case Ending::time_limit:
            return fmt::format("not done at its time limit of {} s",
                               options.time_limit_s);
        case Ending::not_started:
            return fmt::format("cannot be started: {}", std::strerror(ended.number));
    }
    return "";
}

class CommandSimulator : public study::Simulator {
  public:
    explicit CommandSimulator(CommandOptions options)
        : options_(std::move(options)), environment_(environment_for_children()) {
        for (const OutputRule& rule : options_.outputs)
            outputs_.push_back({rule.name, rule.unit});
    }
    /// The folder of the points' folders goes if none of them stayed.
    ~CommandSimulator() override {
        std::error_code ignored;
        fs::remove(options_.folder, ignored);
    }
    CommandSimulator(const CommandSimulator&) = delete;
    CommandSimulator& operator=(const CommandSimulator&) = delete;

    const std::vector<physics::Parameter>& parameters() const override {
        return options_.parameters;
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }
    bool is_slow() const override { return true; }
    /// A full disk, a licence server, a node that was too slow for the time limit.
    bool failures_may_pass() const override { return true; }

    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, outputs_.size(), nan);
        failures.assign(points.rows, {});
        for (std::size_t r = 0; r < points.rows; ++r)
            failures[r] = answer(points.row(r), answers.row(r));
    }

  private:
    /// \return why it failed, or ""
    std::string answer(std::span<const double> point, std::span<double> answers) const {
        const std::string name = name_of_point(point);
        try {
            const fs::path folder = make_folder(options_.folder, name);
            const std::string failure = run_in(folder, point, answers);
            const bool keeps = options_.keep == Keep::all ||
                               (options_.keep == Keep::failed && !failure.empty());
            std::error_code ignored;
            if (!keeps) fs::remove_all(folder, ignored);
            if (failure.empty()) return {};
            return keeps ? fmt::format("{} (in {})", failure, name) : failure;
        } catch (const PointFailure& failure) {
            return failure.what();
        }
    }

    std::string run_in(const fs::path& folder, std::span<const double> point,
                       std::span<double> answers) const {
        try {
            prepare(folder, point);
        } catch (const PointFailure& failure) {
            return failure.what();
        }
        const Ended ended = run_command(command_of(folder, point));
        if (ended.how != Ending::exited || ended.number != 0) {
            const std::string said = last_line(folder, standard_error);
            return how(ended, options_) + (said.empty() ? "" : ": " + said);
        }
        return read_outputs(folder, answers);
    }

    void prepare(const fs::path& folder, std::span<const double> point) const {
        for (const InputFile& input : options_.inputs)
            write_text(folder / input.name, input.text.filled(point));
        for (const fs::path& file : options_.links) link_file(file, folder);
    }

    Command command_of(const fs::path& folder, std::span<const double> point) const {
        Command command{options_.program,      {},
                        environment_,          fs::absolute(folder),
                        standard_output,       standard_error,
                        options_.time_limit_s, options_.output_limit};
        command.arguments.reserve(options_.arguments.size());
        for (const TextTemplate& argument : options_.arguments)
            command.arguments.push_back(argument.filled(point));
        return command;
    }

    std::string read_outputs(const fs::path& folder, std::span<double> answers) const {
        WrittenFiles files(folder, options_.output_limit);
        std::vector<double> values;
        values.reserve(options_.outputs.size());
        for (const OutputRule& rule : options_.outputs) {
            const Reading reading = files.read(rule);
            if (!reading.failure.empty())
                return fmt::format("no {}: {}", rule.name, reading.failure);
            values.push_back(reading.value);
        }
        std::ranges::copy(values, answers.begin());
        return {};
    }

    CommandOptions options_;
    std::vector<std::string> environment_;
    std::vector<study::Output> outputs_;
};

}  // namespace

std::shared_ptr<const study::Simulator> make_command_simulator(CommandOptions options) {
    return std::make_shared<CommandSimulator>(std::move(options));
}

}  // namespace bemcal::external
