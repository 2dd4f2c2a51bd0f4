/// Runs a night over a stock as a stage: items of the first round look which buildings
/// are due, those of later rounds work on them, the most urgent first, within the budget.
/// Follows from hashes of line, job and files, held against the last night's records.
/// A building is worked on by `calibrate`, and not stopped once it has begun.
#include "stock/stage.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/machine.hpp"
#include "input/input_files.hpp"
#include "job/content_hash.hpp"
#include "stock/calibration.hpp"
#include "stock/common.hpp"
#include "stock/drift.hpp"
#include "stock/night.hpp"
#include "stock/shared.hpp"
#include "stock/stopped.hpp"
#include "study/packed_conclusion.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <span>
#include <utility>

namespace bemcal::stock {

namespace {

using study::ItemAnswer;
using study::Round;

constexpr int lines_per_look = 64;
constexpr int least_portion = 32;  ///< of a night that may end: buildings of one round

class StockStage : public study::Stage {
  public:
    StockStage(const job::Job& job, StockNight night)
        : job_(job), stock_(*job.stock), night_(std::move(night)) {
        Hasher hasher;
        hasher.add(std::string_view(job::content_hash(job_.text, job_.file.string())));
        hasher.add(std::string_view(night_.version));
        job_hash_ = hasher.hex();
        for (const StockRecord& record : night_.before) before_[record.name] = &record;
    }

    std::string name() const override { return "stock"; }
    int n_items() const override {
        return (n_lines() + lines_per_look - 1) / lines_per_look;
    }
    /// Buildings, of which some may fail; each is many simulations.
    long long n_simulations() const override { return n_lines(); }
    const char* counts() const override { return "buildings"; }
    bool has_rounds() const override { return true; }
    const char* items_are() const override {
        return due_.empty() ? "items" : "buildings";
    }
    bool failures_may_pass() const override { return true; }
    std::size_t answer_bytes() const override { return 4096; }

    ItemAnswer run(int item) const override {
        return item < n_items() ? look(item) : work_on(due_.at(index(item - first_due_)));
    }

    /// A look is not taken again: what has changed since, the next night finds.
    std::string outdated(int item, const ItemAnswer& answer) const override {
        if (item < n_items() || answer.values.empty()) return {};
        std::size_t used = 0;
        const StockRecord record = unpack_record(answer.values, used);
        const std::string file = changed_file(record);
        return file.empty() ? "" : record.name + ": " + file + " has changed since";
    }

    std::optional<Round> next_round(
        const std::vector<ItemAnswer>& answers) const override {
        const std::vector<int> order = order_of(answers);
        const auto n_done = answers.size() - index(n_items());
        if (n_done >= order.size()) return std::nullopt;
        if (n_done > 0 && night_.is_over && night_.is_over()) return std::nullopt;
        const std::size_t n =
            night_.is_over ? std::max<std::size_t>(order.size() / 16, least_portion)
                           : order.size();
        Round round;
        for (std::size_t k = n_done; k < std::min(n_done + n, order.size()); ++k)
            round.needed.push_back(order[k]);
        round.n_items = static_cast<int>(round.needed.size());
        return round;
    }

    void begin_round(int first_item, const Round& round) override {
        first_due_ = first_item;
        due_.clear();
        for (const double line : round.needed) due_.push_back(static_cast<int>(line));
    }

    study::Conclusion conclude(const std::vector<ItemAnswer>& answers) const override;

  private:
    static std::size_t index(int k) { return static_cast<std::size_t>(k); }
    int n_lines() const { return static_cast<int>(stock_.lines.size()); }
    const job::StockLine& line(int k) const { return stock_.lines[index(k)]; }
    const StockRecord* before(int k) const {
        const auto found = before_.find(line(k).name);
        return found == before_.end() ? nullptr : found->second;
    }

    /// Why a building is due; empty = it is not.
    std::string cause_of(int k) const {
        const StockRecord* last = before(k);
        if (last == nullptr) return "new";
        if (last->line_hash != stock_.hash_of(line(k))) return "line";
        if (last->job_hash != job_hash_) return "job";
        if (const std::string file = changed_file(*last); !file.empty())
            return "data: " + file;
        return last->status == "postponed" ? last->cause : "";
    }

    /// Hash of what a loop's findings follow from, beside readings.
    std::string follows(int k) const {
        Hasher hasher;
        hasher.add(std::string_view(stock_.hash_but_end(line(k))));
        hasher.add(std::string_view(job_hash_));
        return hasher.hex();
    }

    /// Of those that a building was made of, the first that is another now; empty = none.
    std::string changed_file(const StockRecord& record) const {
        for (const auto& [path, hash] : record.files)
            if (stock_.weathers->content_hash(path_of(path)) != hash) return path;
        return {};
    }

    /// Files are known by their names beside the job, wherever it lies.
    std::filesystem::path folder() const {
        return std::filesystem::absolute(job_.file).parent_path().lexically_normal();
    }
    std::filesystem::path path_of(const std::string& name) const {
        return (folder() / name).lexically_normal();
    }
    std::string name_of(const std::filesystem::path& path) const {
        return std::filesystem::absolute(path)
            .lexically_normal()
            .lexically_proximate(folder())
            .string();
    }

    /// The causes of some lines, as records without more.
    ItemAnswer look(int item) const {
        ItemAnswer answer;
        const int first = item * lines_per_look;
        for (int k = first; k < std::min(first + lines_per_look, n_lines()); ++k) {
            StockRecord record;
            record.cause = cause_of(k);
            const auto packed = pack(record);
            answer.values.insert(answer.values.end(), packed.begin(), packed.end());
        }
        return answer;
    }

    ItemAnswer work_on(int k) const {
        ItemAnswer answer;
        Calibrated result;
        std::vector<input::InputFile> log;
        const StockRecord* last = before(k);
        try {
            result = work_through(job_, line(k), last, follows(k), log);
            if (last != nullptr && result.record.status == "calibrated")
                find_drift(stock_.options, *last, result.record);
            if (result.record.status != "unchanged")
                find_error_drift(stock_.options, last, result.record);
        } catch (const std::exception& error) {
            rethrow_unless_answer(error);
            result = {};
            if (last != nullptr) result.record = carried_over(*last);
            result.record.status = "failed";
            result.record.reason = error.what();
            result.record.files.clear();
            answer.failures.push_back({k, result.record.reason});
        }
        result.record.name = line(k).name;
        result.record.line_hash = stock_.hash_of(line(k));
        result.record.job_hash = job_hash_;
        for (const input::InputFile& file : log)
            result.record.files.push_back({name_of(file.path), file.hash});
        answer.values = pack(result.record);
        if (stock_.options.keep_results && answer.failures.empty()) {
            for (study::Summary& summary : result.conclusion.summaries) {
                summary.points = {};     // nothing goes on with them
                summary.shortfall = {};  // it is a finding; the batch has not failed
            }
            const auto whole = study::pack(result.conclusion);
            answer.values.insert(answer.values.end(), whole.begin(), whole.end());
        }
        return answer;
    }

    std::vector<std::string> causes_in(const std::vector<ItemAnswer>& answers) const {
        std::vector<std::string> causes;
        for (std::size_t item = 0; item < index(n_items()); ++item) {
            std::span<const double> rest(answers[item].values);
            while (!rest.empty()) {
                std::size_t used = 0;
                causes.push_back(unpack_record(rest, used).cause);
                rest = rest.subspan(used);
            }
        }
        causes.resize(index(n_lines()));
        return causes;
    }

    /// 0 first.
    int urgency(int k) const {
        const StockRecord* last = before(k);
        if (last == nullptr) return 3;
        return last->is_failed()             ? 0
               : last->status == "postponed" ? 1
               : last->drift.empty()         ? 3
                                             : 2;
    }

    double cost_of(int k) const {
        const StockRecord* last = before(k);
        return last != nullptr && last->simulations > 0
                   ? last->simulations
                   : usual_simulations(job_.studies[0]);
    }

    /// The due, the most urgent first, as far as the budget goes.
    std::vector<int> order_of(const std::vector<ItemAnswer>& answers) const {
        const auto causes = causes_in(answers);
        std::vector<int> order;
        for (int k = 0; k < n_lines(); ++k)
            if (!causes[index(k)].empty()) order.push_back(k);
        std::ranges::stable_sort(order, {}, [&](int k) { return urgency(k); });
        if (stock_.options.budget <= 0) return order;
        double cost = 0;
        std::size_t n = 0;
        while (n < order.size() && cost < stock_.options.budget)
            cost += cost_of(order[n++]);
        order.resize(n);
        return order;
    }

    /// Of a building that nothing was done with.
    StockRecord untouched(int k, const std::string& cause) const {
        const StockRecord* last = before(k);
        StockRecord record = carried_over(last != nullptr ? *last : StockRecord{});
        record.name = line(k).name;
        if (!cause.empty())
            record.status = "postponed";
        else if (!record.is_failed())
            record.status = "unchanged";
        record.cause = cause;
        return record;
    }

    /// \param answer  of this night; nullptr = nothing was done with it
    StockRecord record_of(int k, const std::string& cause,
                          const ItemAnswer* answer) const;
    /// With keep_results; else nothing.
    static study::Conclusion whole_result_in(const ItemAnswer& answer);

    const job::Job& job_;
    const job::Stock& stock_;
    StockNight night_;
    std::string job_hash_;
    std::map<std::string, const StockRecord*> before_;
    int first_due_ = 0;
    std::vector<int> due_;
};

StockRecord StockStage::record_of(int k, const std::string& cause,
                                  const ItemAnswer* answer) const {
    if (answer == nullptr) return untouched(k, cause);
    if (answer->values.empty()) {  // it took too long
        StockRecord record = untouched(k, cause);
        record.status = "failed";
        record.reason = answer->error;
        return record;
    }
    std::size_t used = 0;
    StockRecord record = unpack_record(answer->values, used);
    record.cause = cause;
    return record;
}

study::Conclusion StockStage::conclude(const std::vector<ItemAnswer>& answers) const {
    const std::vector<std::string> causes = causes_in(answers);
    const std::vector<int> order = order_of(answers);
    std::vector<const ItemAnswer*> done(causes.size(), nullptr);
    for (std::size_t at = index(n_items()); at < answers.size(); ++at)
        done[index(order.at(at - index(n_items())))] = &answers[at];
    const auto record = [&](std::size_t k) {
        return record_of(static_cast<int>(k), causes[k], done[k]);
    };
    std::vector<StockRecord> parts(causes.size());
    CommonEffects common;
    PlaceEffects place;
    std::vector<double> ends;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const StockRecord whole = record(k);
        common.add(whole);
        place.add(whole);
        ends.push_back(end_of_readings(whole));
        parts[k] = shared_part(whole);
    }
    const std::vector<OfAll> of_all = place.of_all();
    common.compare(of_all);
    find_shared_meters(parts);
    const double middle = middle_end(std::move(ends));
    study::Conclusion night;
    night.datasets = datasets_of(causes.size(), [&](std::size_t k) {
        StockRecord whole = record(k);
        take_shared(std::exchange(parts[k], {}), whole);
        common.write(k, whole);
        const bool is_said = !stock_.lines[k].cell("to").empty();
        tell_of_end(is_said ? 0 : middle, whole);
        return whole;
    });
    std::ranges::move(common.datasets(), std::back_inserter(night.datasets));
    std::ranges::move(datasets_of(of_all), std::back_inserter(night.datasets));
    night.datasets.push_back({"stock/kind", {}, {}, {}, {"stock"}});
    for (std::size_t at = index(n_items()); at < answers.size(); ++at) {
        study::Conclusion whole = whole_result_in(answers[at]);
        std::ranges::move(whole.datasets, std::back_inserter(night.datasets));
        std::ranges::move(whole.summaries, std::back_inserter(night.summaries));
    }
    return night;
}

study::Conclusion StockStage::whole_result_in(const ItemAnswer& answer) {
    if (answer.values.empty()) return {};
    std::size_t used = 0;
    unpack_record(answer.values, used);
    if (used == answer.values.size()) return {};
    return study::unpack_conclusion(std::span(answer.values).subspan(used));
}

}  // namespace

std::unique_ptr<study::Stage> make_stock_stage(const job::Job& job, StockNight night) {
    return std::make_unique<StockStage>(job, std::move(night));
}

}  // namespace bemcal::stock
