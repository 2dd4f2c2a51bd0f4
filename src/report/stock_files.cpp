/// What a night over a stock leaves beside its result: its table as CSV, and a history of
/// all nights, in which a night done again is replaced.
/// Plain handling of files, without a source; written under another name first. What a
/// line says is stock_tables'. The page is a script's.
#include "report/stock_files.hpp"

#include "base/error.hpp"
#include "report/stock_tables.hpp"

#include <fstream>
#include <sstream>
#include <string>

namespace bemcal::report {
namespace {

namespace fs = std::filesystem;

/// Under another name first, so that there is never half of it.
void write_text(const fs::path& path, const std::string& text) {
    fs::path temporary = path;
    temporary += ".tmp";
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    std::error_code error;
    if (out) fs::rename(temporary, path, error);
    if (!out || error)
        throw UserError(ExitCode::io, path.string() + ": cannot be written");
}

/// The lines of the other nights, without the head.
std::string other_nights(const fs::path& history, const std::string& night) {
    std::ifstream in(history);
    std::string text, line;
    std::getline(in, line);
    while (std::getline(in, line))
        if (!line.starts_with(night + ",")) text += line + "\n";
    return text;
}

}  // namespace

std::optional<StockFiles> write_stock_files(const fs::path& file,
                                            const store::ResultFile& result) {
    const auto stocks = groups_with(result, "stock_building");
    if (stocks.empty()) return std::nullopt;
    const std::string night = file.stem().string();
    StockFiles files{file, file};
    files.table.replace_extension(".csv");
    files.history.replace_filename(result.attributes.at("title") + "-history.csv");
    write_text(files.table, stock_csv(stocks[0]));
    write_text(files.history, stock_history_head() + other_nights(files.history, night) +
                                  stock_history(stocks[0], night));
    return files;
}

}  // namespace bemcal::report
