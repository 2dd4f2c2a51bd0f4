/// Dates of lunar calendars from a table of their years: first day, leap month, lengths.
/// Source: new moons by Meeus, Astronomical Algorithms, ch. 49, the sun's longitude by
/// ch. 25, months numbered by the rule of 1645 (the winter solstice is in month 11; a
/// year with 13 moons has its leap month where the sun reaches no multiple of 30
/// degrees), days of UTC+8 and UTC+9. The Hong Kong Observatory's new years are the same.
/// Left out: other years, leap months as dates.
#include "holidays/lunar.hpp"

#include <cstddef>

namespace bemcal::holidays {
namespace {

struct LunarYear {
    int new_year;    ///< month and day of its first day, as 205 for 5 February
    int leap;        ///< the leap month comes after this one; 0 = there is none
    unsigned longs;  ///< bit k: the k-th month, from 0, has 30 days, not 29
};

// The years from 2000 on, four a line.
constexpr LunarYear chinese_years[] = {
    {205, 0, 0x0693}, {124, 4, 0x152b},  {212, 0, 0x052b}, {201, 0, 0x0a5b},
    {122, 2, 0x155a}, {209, 0, 0x056a},  {129, 7, 0x1b55}, {218, 0, 0x0ba4},
    {207, 0, 0x0b49}, {126, 5, 0x1a93},  {214, 0, 0x0a95}, {203, 0, 0x052d},
    {123, 4, 0x0aad}, {210, 0, 0x0ab5},  {131, 9, 0x15aa}, {219, 0, 0x05d2},
    {208, 0, 0x0da5}, {128, 6, 0x1d4a},  {216, 0, 0x0d4a}, {205, 0, 0x0c95},
    {125, 4, 0x152e}, {212, 0, 0x0556},  {201, 0, 0x0ab5}, {122, 2, 0x15b2},
    {210, 0, 0x06d2}, {129, 6, 0x0ea5},  {217, 0, 0x0725}, {206, 0, 0x064b},
    {126, 5, 0x0c97}, {213, 0, 0x0cab},  {203, 0, 0x055a}, {123, 3, 0x0ad6},
    {211, 0, 0x0b69}, {131, 11, 0x1752}, {219, 0, 0x0b52}, {208, 0, 0x0b25},
    {128, 6, 0x1a4b}, {215, 0, 0x0a4b},  {204, 0, 0x04ab}, {124, 5, 0x055b},
    {212, 0, 0x05ad}, {201, 0, 0x0b6a},  {122, 2, 0x1b52}, {210, 0, 0x0d92},
    {130, 7, 0x1d25}, {217, 0, 0x0d25},  {206, 0, 0x0a55}, {126, 5, 0x14ad},
    {214, 0, 0x04b6}, {202, 0, 0x05b5},  {123, 3, 0x0daa},
};
constexpr LunarYear korean_years[] = {
    {205, 0, 0x0693}, {124, 4, 0x1527},  {212, 0, 0x052b}, {201, 0, 0x0a5b},
    {122, 2, 0x155a}, {209, 0, 0x036a},  {129, 7, 0x1b55}, {218, 0, 0x0ba4},
    {207, 0, 0x0b49}, {126, 5, 0x1a93},  {214, 0, 0x0a95}, {203, 0, 0x052d},
    {123, 3, 0x0a5d}, {210, 0, 0x0aad},  {131, 9, 0x15aa}, {219, 0, 0x05d2},
    {208, 0, 0x0da5}, {128, 5, 0x1d4a},  {216, 0, 0x0d4a}, {205, 0, 0x0a95},
    {125, 4, 0x152d}, {212, 0, 0x0556},  {201, 0, 0x0ab5}, {122, 2, 0x15aa},
    {210, 0, 0x06d2}, {129, 6, 0x0ea5},  {217, 0, 0x0ea5}, {207, 0, 0x0e4a},
    {127, 5, 0x0c96}, {213, 0, 0x0c9b},  {203, 0, 0x055a}, {123, 3, 0x0ad5},
    {211, 0, 0x0b69}, {131, 11, 0x1752}, {219, 0, 0x0752}, {208, 0, 0x0b25},
    {128, 6, 0x164b}, {215, 0, 0x0a4b},  {204, 0, 0x04ab}, {124, 5, 0x055b},
    {212, 0, 0x056d}, {201, 0, 0x0b69},  {122, 2, 0x1b52}, {210, 0, 0x0d92},
    {130, 7, 0x1d25}, {217, 0, 0x0d25},  {206, 0, 0x0a4d}, {126, 5, 0x14ad},
    {214, 0, 0x02b6}, {202, 0, 0x05b5},  {123, 3, 0x0da9},
};

static_assert(std::size(chinese_years) == last_lunar_year - first_lunar_year + 1);
static_assert(std::size(korean_years) == std::size(chinese_years));

}  // namespace

std::optional<std::chrono::sys_days> lunar_date(LunarCalendar calendar, int year,
                                                int month, int day) {
    using namespace std::chrono;
    if (year < first_lunar_year || year > last_lunar_year) return std::nullopt;
    const auto row = static_cast<std::size_t>(year - first_lunar_year);
    const LunarYear& lunar =
        calendar == LunarCalendar::chinese ? chinese_years[row] : korean_years[row];
    sys_days begin =
        std::chrono::year(year) / (lunar.new_year / 100) / (lunar.new_year % 100);
    const int before = month - 1 + (lunar.leap > 0 && month > lunar.leap ? 1 : 0);
    for (int k = 0; k < before; ++k) begin += days(29 + (lunar.longs >> k & 1));
    return begin + days(day - 1);
}

}  // namespace bemcal::holidays
