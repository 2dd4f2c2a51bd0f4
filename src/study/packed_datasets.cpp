/// Writes datasets as an item's numbers and reads them again: counts before contents, a
/// text as its bytes, one to a number.
/// Follows from the fields of `Dataset`, in their order.
/// Nothing is compressed or checked: `unpack` takes what `pack` wrote.
#include "study/packed_datasets.hpp"

namespace bemcal::study {
namespace {

class Packer {
  public:
    void number(double value) { packed.push_back(value); }
    void count(std::size_t n) { number(static_cast<double>(n)); }
    void text(const std::string& text) {
        count(text.size());
        for (const char c : text) number(static_cast<unsigned char>(c));
    }
    void texts(const std::vector<std::string>& texts) {
        count(texts.size());
        for (const std::string& one : texts) text(one);
    }

    std::vector<double> packed;
};

class Unpacker {
  public:
    explicit Unpacker(std::span<const double> packed) : rest_(packed) {}

    double number() {
        const double value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }
    std::size_t count() { return static_cast<std::size_t>(number()); }
    std::string text() {
        std::string text(count(), ' ');
        for (char& c : text) c = static_cast<char>(static_cast<unsigned char>(number()));
        return text;
    }
    std::vector<std::string> texts() {
        std::vector<std::string> texts(count());
        for (std::string& one : texts) one = text();
        return texts;
    }

  private:
    std::span<const double> rest_;
};

}  // namespace

std::vector<double> pack(const std::vector<Dataset>& datasets) {
    Packer packer;
    packer.count(datasets.size());
    for (const Dataset& dataset : datasets) {
        packer.text(dataset.path);
        packer.texts(dataset.dims);
        packer.count(dataset.shape.size());
        for (const std::size_t extent : dataset.shape) packer.count(extent);
        packer.count(dataset.values.size());
        for (const double value : dataset.values) packer.number(value);
        packer.texts(dataset.texts);
        packer.text(dataset.unit);
    }
    return std::move(packer.packed);
}

std::vector<Dataset> unpack(std::span<const double> packed) {
    Unpacker unpacker(packed);
    std::vector<Dataset> datasets(unpacker.count());
    for (Dataset& dataset : datasets) {
        dataset.path = unpacker.text();
        dataset.dims = unpacker.texts();
        dataset.shape.resize(unpacker.count());
        for (std::size_t& extent : dataset.shape) extent = unpacker.count();
        dataset.values.resize(unpacker.count());
        for (double& value : dataset.values) value = unpacker.number();
        dataset.texts = unpacker.texts();
        dataset.unit = unpacker.text();
    }
    return datasets;
}

}  // namespace bemcal::study
