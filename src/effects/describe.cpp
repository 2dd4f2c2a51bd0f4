/// The catalogue and the grammar as text, for `describe effects`: where an effect enters,
/// what it follows, what it leaves in residuals, what tells it apart.
/// Made from the rows of the catalogue, of hooks and of the grammar's groups.
/// Of many shapes only some are printed.
#include "effects/catalogue.hpp"
#include "effects/drivers.hpp"
#include "effects/grammar.hpp"
#include "effects/hooks.hpp"

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

const char* words_of(Each each) {
    constexpr const char* words[] = {"",
                                     "all facades together, and each alone",
                                     "every meter",
                                     "the meter of cooling",
                                     "Monday to Friday, each alone",
                                     "the summer times of the EU and the US",
                                     "days picked in the data (for holidays only)",
                                     "each schedule, with hours found by simulation",
                                     "a decision on the data: the model is not changed"};
    return words[static_cast<std::size_t>(each)];
}

std::string tried(const Entry& entry) {
    std::string text;
    for (const Shape& shape : entry.shapes) {
        Effect effect = entry.effect;
        effect.shape = shape;
        if (entry.shapes.size() > 8 && &shape == &entry.shapes[2]) text += "; ...";
        if (entry.shapes.size() > 8 && &shape > &entry.shapes[1] &&
            &shape < &entry.shapes.back())
            continue;
        text += fmt::format("{}{}", text.empty() ? "" : "; ", sentence_of(effect));
    }
    return text.empty() ? sentence_of(entry.effect) : text;
}

std::string lines_of(const Entry& entry) {
    const Effect& effect = entry.effect;
    std::string text =
        fmt::format("{:2}  {}\n    {}\n", effect.number, effect.name, entry.sentence);
    if (entry.each != Each::data)
        text +=
            fmt::format("    enters at:   {}, {:.4g} to {:.4g} {}\n    follows:     {}\n",
                        name_of(effect.hook), effect.least, effect.most, unit_of(effect),
                        tried(entry));
    if (entry.each != Each::once)
        text += fmt::format("    on:          {}\n", words_of(entry.each));
    return text + fmt::format(
                      "    leaves:      {}\n    like:        {}\n"
                      "    told apart:  {}\n\n",
                      entry.signature, entry.like, entry.separates);
}

std::string hooks() {
    std::string text;
    for (const HookRow& row : hook_rows())
        text += fmt::format("    {:22} {}\n", row.name, row.unit);
    return text;
}

std::string drivers() {
    std::string text;
    for (const DriverRow& row : driver_rows())
        text += fmt::format("    {:32} {}\n", row.name, unit_of_values(row.driver));
    return text;
}

std::string groups() {
    std::string text;
    for (const GroupRow& row : group_rows) text += fmt::format("    {}\n", row.words);
    return text;
}

}  // namespace

std::string describe() {
    std::string text =
        "Effects that a loop looks for. What one brings to the building at a step is\n"
        "coefficient x shape(driver) x gate; a sign outside of the plausible range "
        "printed\nhere is not tried, and a coefficient beyond its ends by more than a "
        "factor of 1.5\nis refused.\n\n";
    for (const Entry& entry : catalogue()) text += lines_of(entry);
    text +=
        "Beside them a loop tries what has no name, wherever it makes sense: a grammar\n"
        "of hooks x drivers. Drivers:\n\n";
    text += groups() + "\nHooks and units of their coefficients:\n\n" + hooks();
    return text + "\nWhat an [[effect]] may follow, and the unit of its `at`:\n\n" +
           drivers();
}

}  // namespace bemcal::effects
