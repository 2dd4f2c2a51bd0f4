/// What a hook of the grammar may follow, in groups: a hook's row says which of them it
/// takes (hooks.cpp), a driver's row what it brings to one (drivers.cpp).
#pragma once

namespace bemcal::effects {

/// In the order in which candidates are listed.
struct Follows {
    enum Group : unsigned {
        hours = 1,
        days = 2,
        seasons = 4,
        trend = 8,
        steps = 16,
        temperature = 32,
        wind = 64,
        sun = 128,
        moisture = 256,
        absence = 512,
        columns = 1024
    };
    static constexpr unsigned calendar = hours | days | seasons;
    static constexpr unsigned anything =
        calendar | temperature | absence | steps | columns;
};

struct GroupRow {
    Follows::Group group;
    const char* words;  ///< for `describe effects`
};

inline constexpr GroupRow group_rows[] = {
    {Follows::hours, "hour of the day (windows of 3 h on weekdays)"},
    {Follows::days, "weekends and their days"},
    {Follows::seasons, "seasons (2 months)"},
    {Follows::trend, "a trend"},
    {Follows::steps, "steps at every month"},
    {Follows::temperature, "outdoor temperature (hinges at 5 to 25 degC)"},
    {Follows::wind, "wind"},
    {Follows::sun, "sun"},
    {Follows::moisture, "moisture"},
    {Follows::absence, "absence of people"},
    {Follows::columns, "the job's own columns"}};

}  // namespace bemcal::effects
