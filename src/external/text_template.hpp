/// A text with places for numbers and texts: `@infiltration@`.
///
/// A name begins with a letter and goes on with letters, digits and underscores; any
/// other @ is itself. Not a template library: their braces mean something in other
/// programs' inputs, and an unknown name has to be told by its line.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::external {

class TextTemplate {
  public:
    /// \param where  the file, for messages
    /// \param names  of the numbers, and of texts behind them
    /// Throws UserError "FILE:LINE: ..." where a place names none of them.
    TextTemplate(std::string_view text, const std::string& where,
                 const std::vector<std::string>& names);

    bool uses(std::size_t name) const;
    /// With each number in the fewest digits that give it back: 0.1, 20, 1e-07.
    /// \param texts  of the names behind those of the numbers
    std::string filled(std::span<const double> values,
                       std::span<const std::string> texts = {}) const;

  private:
    struct Place {
        std::string before;  ///< text up to it
        std::size_t name;
    };
    std::vector<Place> places_;
    std::string rest_;
};

}  // namespace bemcal::external
