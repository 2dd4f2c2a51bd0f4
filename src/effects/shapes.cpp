/// Short words for shapes: thresholds, windows, seasons and dates.
/// Our own choice, without a source. Dates of steps are tried by months, up to the 23rd:
/// finer ones are left to the search.
#include "effects/shapes.hpp"

namespace bemcal::effects {

std::vector<Shape> at_each(Form form, std::initializer_list<double> thresholds) {
    std::vector<Shape> shapes;
    shapes.reserve(thresholds.size());
    for (const double at : thresholds) shapes.push_back({form, at});
    return shapes;
}

std::vector<Shape> windows(std::initializer_list<Hours> ends) {
    std::vector<Shape> shapes;
    shapes.reserve(ends.size());
    for (const Hours& window : ends)
        shapes.push_back({Form::within, window.from, window.until});
    return shapes;
}

std::vector<Shape> seasons() {
    return windows({{334, 59},
                    {59, 151},
                    {151, 243},
                    {243, 334},
                    {304, 59},
                    {120, 243},
                    {90, 273},
                    {273, 90}});
}

Effect from_a_date(const char* name, int number, Hook hook, double least, double most,
                   double typical) {
    return {.name = name,
            .number = number,
            .hook = hook,
            .driver = Driver::elapsed,
            .shape = {Form::over, 0.5},
            .least = least,
            .most = most,
            .typical = typical};
}

std::vector<Shape> dates() {
    std::vector<Shape> shapes;
    for (int month = 1; month < 24; ++month) shapes.push_back({Form::over, month / 12.0});
    return shapes;
}

}  // namespace bemcal::effects
