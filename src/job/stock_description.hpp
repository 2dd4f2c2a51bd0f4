/// A building's description from a few columns of a stock's table: a box.
///
/// floor_area [m2] is all that is needed of the building; floors, height [m] of a storey,
/// glass_share of the walls, class, u_wall, u_roof, u_floor, u_window and efficiency may
/// be said. Data: weather (EPW, or CSV with outdoor_temperature and global_horizontal as
/// columns, latitude, longitude, utc_offset), and for each of gas, electricity, heat a
/// file, with NAME_column and NAME_unit where they are not the building's name and kWh;
/// of gas the unit may be `auto`: the one of kWh, m3 and 100 ft3 that makes a year's
/// gas by square metre most like a building's. Numbers of the box have ranges. NAME_KEY,
/// as gas_time_format, says a key of that meter, weather_KEY one of the weather,
/// `interval` that of all meters, and `year` that the weather is a typical year's that
/// stands for this one and those after it. Periods are from and to, or where readings
/// begin and end. Use is that of offices; eleven parameters take up what that misses.
#pragma once

#include "input/input_files.hpp"
#include "job/stock.hpp"

#include <vector>

namespace bemcal::job {

struct Description {
    std::string text;                            ///< TOML
    std::vector<study::DataDecision> decisions;  ///< what was chosen by itself, and why
};

/// The columns that a description may follow from; others are the table's own.
std::vector<std::string> read_columns();

/// Throws UserError with TABLE:LINE and the column.
Description describe_line(const Stock& stock, const StockLine& line,
                          input::InputFiles& files);

}  // namespace bemcal::job
