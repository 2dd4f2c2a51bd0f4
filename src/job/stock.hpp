/// A stock: many buildings, one line of a table (or one file of a folder) each, and what
/// is done with every one of them.
///
/// A line becomes a building only where it is worked on: nothing but the table is read
/// beforehand, so that a broken building is one failed item, and memory does not grow
/// with the stock. A building's text is its own file, the stock's template with
/// `@column@` filled from the line, or the description that its columns give
/// (stock_description.hpp). Sections that it leaves out are the job's.
#pragma once

#include "description/weather_memory.hpp"
#include "job/adopted.hpp"
#include "job/job.hpp"
#include "schema/section.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::job {

/// How far ends of readings are apart that say nothing [d]: files come late by days, and
/// a fortnight is half of what a night looks at.
inline constexpr int most_days_late = 14;

struct StockLine {
    int line = 0;  ///< of the table; 0 in a folder
    std::string name;
    std::shared_ptr<const std::vector<std::string>> columns;  ///< sorted; of all lines
    std::vector<std::string> cells;                           ///< in their order
    std::string complaint;  ///< why it is none; empty = it is one
    bool has(const std::string& column) const { return find(column) != nullptr; }
    /// The cell, or nothing where there is no such column or it is empty.
    std::string cell(const std::string& column) const;
    /// \return nullptr where there is no such column; throws UserError where there are
    /// two
    const std::string* find(const std::string& column) const;
};

struct StockOptions {
    double recent_days = 28;    ///< kept from the calibration, at the end of the readings
    double window_days = 365;   ///< calibrated on, before these
    double budget = 0;          ///< simulations of a night; 0 = no limit
    double hours = 0;           ///< after which no building is begun; 0 = no limit
    double drift_value = 0.2;   ///< of the range
    double drift_error = 1.5;   ///< recent RMSE over that of training
    bool keep_results = false;  ///< every building's whole result as well
    double false_alarms = 1e-3;  ///< of a building in a week; 0 = always a new search
};

class Stock {
  public:
    std::filesystem::path table;  ///< or the folder
    std::string template_name;    ///< "" = none
    std::string template_text;
    std::vector<StockLine> lines;
    StockOptions options;
    std::shared_ptr<description::WeatherMemory> weathers;

    /// What the line and its template say, before any data are read.
    std::string hash_of(const StockLine& line) const;
    /// The same without the last day to use, which moves from night to night.
    std::string hash_but_end(const StockLine& line) const;

  private:
    std::string hash_without(const StockLine& line, std::string_view column) const;
};

/// [stock] of a job. A line that cannot be read keeps its complaint.
std::shared_ptr<Stock> read_stock(const schema::Section& section,
                                  input::InputFiles& files);

/// The job that a table alone stands for.
std::string job_text_of_table(const std::string& table);

/// A job of this one building, with the stock's studies and random numbers of its own.
/// Throws UserError as any job does.
/// \param adopted  laid over it, in its periods; nullptr = the building as described
Job read_stock_building(const Job& stock_job, const StockLine& line,
                        input::InputFiles& files, const Adopted* adopted = nullptr);

}  // namespace bemcal::job
