/// Writes a conclusion as an item's numbers and reads it again: counts before contents, a
/// text as its bytes, one to a number.
/// Follows from one list of fields for each struct, in their order, by which both go.
/// Nothing is compressed or checked: `unpack_conclusion` takes what `pack` wrote.
#include "study/packed_conclusion.hpp"

#include <concepts>
#include <type_traits>

namespace bemcal::study {
namespace {

/// Of T, and constant when it is written.
template <class Of, class T>
concept is_a = std::same_as<std::remove_const_t<Of>, T>;

void visit(is_a<Dataset> auto& dataset, auto&& see) {
    see(dataset.path);
    see(dataset.dims);
    see(dataset.shape);
    see(dataset.values);
    see(dataset.texts);
    see(dataset.unit);
}
void visit(is_a<DataDecision> auto& decision, auto&& see) {
    see(decision.series);
    see(decision.finding);
    see(decision.action);
    see(decision.kind);
}
void visit(is_a<FoundValue> auto& value, auto&& see) {
    see(value.name);
    see(value.value);
    see(value.low);
    see(value.high);
}
void visit(is_a<FoundFit> auto& fit, auto&& see) {
    see(fit.period);
    see(fit.meter);
    see(fit.before);
    see(fit.cv_rmse);
    see(fit.nmbe);
}
void visit(is_a<PossibleName> auto& name, auto&& see) {
    see(name.name);
    see(name.probability);
}
void visit(is_a<PlaceEffect> auto& effect, auto&& see) {
    see(effect.name);
    see(effect.unit);
    see(effect.typical);
    see(effect.coefficient);
    see(effect.sd);
}
void visit(is_a<FoundPart> auto& part, auto&& see) {
    see(part.effect);
    see(part.section);
    see(part.unit);
    see(part.coefficient);
    see(part.least);
    see(part.most);
    see(part.names);
}
void visit(is_a<FoundPoints> auto& points, auto&& see) {
    see(points.parameters);
    see(points.rows.rows);
    see(points.rows.cols);
    see(points.rows.values);
}
void visit(is_a<effects::HookSeries> auto& at, auto&& see) {
    see(at.hook);
    see(at.unit);
    see(at.is_factor);
    see(at.facade);
    see(at.meter);
    see(at.values);
    see(at.opens_above);
}
void visit(is_a<GivenEffect> auto& effect, auto&& see) {
    see(effect.name);
    see(effect.at);
}
void visit(is_a<Summary> auto& summary, auto&& see) {
    see(summary.study);
    see(summary.building);
    see(summary.values);
    see(summary.fits);
    see(summary.points);
    see(summary.given);
    see(summary.findings);
    see(summary.parts);
    see(summary.undecided);
    see(summary.of_the_place);
    see(summary.score);
    see(summary.failure);
    see(summary.shortfall);
}
void visit(is_a<Conclusion> auto& conclusion, auto&& see) {
    see(conclusion.datasets);
    see(conclusion.summaries);
}

template <class T>
constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Packer {
  public:
    template <class T>
    void operator()(const T& value) {
        if constexpr (is_number<T>)
            packed.push_back(static_cast<double>(value));
        else
            visit(value, *this);
    }
    template <class T>
    void operator()(const std::vector<T>& values) {
        (*this)(values.size());
        for (const T& value : values) (*this)(value);
    }
    void operator()(const std::string& text) {
        (*this)(text.size());
        for (const char c : text) (*this)(static_cast<unsigned char>(c));
    }

    std::vector<double> packed;
};

class Unpacker {
  public:
    explicit Unpacker(std::span<const double> packed) : rest_(packed) {}

    template <class T>
    void operator()(T& value) {
        if constexpr (is_number<T>)
            value = static_cast<T>(next());
        else
            visit(value, *this);
    }
    template <class T>
    void operator()(std::vector<T>& values) {
        values.resize(static_cast<std::size_t>(next()));
        for (T& value : values) (*this)(value);
    }
    void operator()(std::string& text) {
        text.resize(static_cast<std::size_t>(next()));
        for (char& c : text) c = static_cast<char>(static_cast<unsigned char>(next()));
    }

  private:
    double next() {
        const double value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }

    std::span<const double> rest_;
};

}  // namespace

std::vector<double> pack(const Conclusion& conclusion) {
    Packer packer;
    packer(conclusion);
    return std::move(packer.packed);
}

Conclusion unpack_conclusion(std::span<const double> packed) {
    Conclusion conclusion;
    Unpacker unpacker(packed);
    unpacker(conclusion);
    return conclusion;
}

}  // namespace bemcal::study
