/// Attributes and datasets of a result, from HDF5 in a process of its own through a pipe,
/// each length checked against what the file can hold.
/// Plain format of our own, between two processes of one program. The layout of datasets
/// is not looked at here, nor their hash.
#include "store/result_reading.hpp"

#include "base/apart.hpp"
#include "base/error.hpp"
#include "store/hdf5.hpp"

#include <cstdint>
#include <cstdio>
#include <functional>
#include <new>
#include <system_error>

#include <fmt/format.h>

namespace bemcal::store {
namespace {

namespace fs = std::filesystem;
using study::Dataset;
using Texts = std::map<std::string, std::string>;

/// What comes next through the pipe.
enum class Tag : std::uint8_t { head, dataset, end, error };

/// Writes each value with its length.
class Sender {
  public:
    explicit Sender(std::FILE* to) : to_(to) {}

    void operator()(Tag tag) { put(&tag, sizeof tag); }
    void operator()(bool value) { put(&value, sizeof value); }
    void operator()(const std::string& text) {
        count(text.size());
        put(text.data(), text.size());
    }
    template <class Value>
    void operator()(const std::vector<Value>& values) {
        count(values.size());
        if constexpr (std::is_arithmetic_v<Value>)
            put(values.data(), values.size() * sizeof(Value));
        else
            for (const Value& value : values) (*this)(value);
    }
    void operator()(const Texts& texts) {
        count(texts.size());
        for (const auto& [name, text] : texts) {
            (*this)(name);
            (*this)(text);
        }
    }

  private:
    void count(std::uint64_t n) { put(&n, sizeof n); }
    void put(const void* data, std::size_t bytes) {
        if (bytes > 0) std::fwrite(data, 1, bytes, to_);
    }
    std::FILE* to_;
};

/// The other process ended before its end.
struct Broken {};

/// Reads what a Sender wrote.
class Receiver {
  public:
    Receiver(std::FILE* from, double most_bytes) : from_(from), left_(most_bytes) {}

    void operator()(Tag& tag) { get(&tag, sizeof tag); }
    void operator()(bool& value) {
        std::uint8_t byte = 0;
        get(&byte, sizeof byte);
        value = byte != 0;
    }
    void operator()(std::string& text) {
        text.resize(count(1));
        get(text.data(), text.size());
    }
    template <class Value>
    void operator()(std::vector<Value>& values) {
        if constexpr (std::is_arithmetic_v<Value>) {
            values.resize(count(sizeof(Value)));
            get(values.data(), values.size() * sizeof(Value));
        } else {
            values.resize(count(sizeof(std::uint64_t)));
            for (Value& value : values) (*this)(value);
        }
    }
    void operator()(Texts& texts) {
        for (std::size_t n = count(1); n > 0; --n) {
            std::string name;
            (*this)(name);
            (*this)(texts[name]);
        }
    }

  private:
    /// Of things of at least that size.
    std::size_t count(std::size_t size) {
        std::uint64_t n = 0;
        get(&n, sizeof n);
        if (static_cast<double>(n) * static_cast<double>(size) > left_)
            throw hdf5::Error("it holds more than its size allows");
        return n;
    }
    void get(void* to, std::size_t bytes) {
        left_ -= static_cast<double>(bytes);
        if (bytes > 0 && std::fread(to, 1, bytes, from_) != bytes) throw Broken();
    }
    std::FILE* from_;
    double left_;
};

/// Everything but the datasets.
template <class Wire, class Result>
void pass_head(Wire& wire, Result& result) {
    wire(result.attributes);
    wire(result.run);
    wire(result.complete);
    wire(result.hash);
    wire(result.labels_hash);
}

template <class Wire, class Values>
void pass_dataset(Wire& wire, Values& dataset) {
    wire(dataset.path);
    wire(dataset.dims);
    wire(dataset.shape);
    wire(dataset.values);
    wire(dataset.texts);
    wire(dataset.unit);
}

std::string taken_from(Texts& attributes, const char* name) {
    const auto node = attributes.extract(name);
    return node ? node.mapped() : std::string();
}

ResultFile head_of(const hdf5::File& file) {
    ResultFile head;
    head.attributes = file.attributes("/");
    head.complete = taken_from(head.attributes, complete_mark) == "yes";
    head.hash = taken_from(head.attributes, hash_mark);
    head.labels_hash = taken_from(head.attributes, labels_mark);
    if (file.has(run_group)) head.run = file.attributes(run_group);
    if (!head.attributes.contains("program"))
        throw hdf5::Error("it is an HDF5 file, but bemcal-batch did not write it");
    return head;
}

Dataset dataset_of(hdf5::File& file, const std::string& path) {
    hdf5::Array array = file.read(path);
    auto attributes = file.attributes(path);
    return {path,
            std::move(array.dims),
            std::move(array.shape),
            std::move(array.values),
            std::move(array.texts),
            attributes["units"]};
}

bool is_wanted(const std::string& path, const std::string& group) {
    return !path.starts_with(std::string(run_group) + "/") &&
           (group.empty() || path.starts_with(group + "/"));
}

/// Calls head and then dataset for each, in the order of their paths.
template <class Head, class Each>
void read_all(const fs::path& path, const std::string& group, Head&& head, Each&& each) {
    hdf5::File file = hdf5::File::open(path);
    head(head_of(file));
    for (const std::string& dataset : file.dataset_paths())
        if (is_wanted(dataset, group)) each(dataset_of(file, dataset));
}

/// In the other process.
void send_all(const fs::path& path, const std::string& group, Sender& out) {
    try {
        read_all(
            path, group,
            [&](const ResultFile& head) {
                out(Tag::head);
                pass_head(out, head);
            },
            [&](const Dataset& dataset) {
                out(Tag::dataset);
                pass_dataset(out, dataset);
            });
        out(Tag::end);
    } catch (const hdf5::Error& error) {
        out(Tag::error);
        out(std::string(error.what()));
    }
}

/// Throws hdf5::Error with what the other process says, Broken where it says no more.
void receive_all(Receiver& in, ResultFile& result) {
    for (Tag tag = Tag::head; in(tag), tag != Tag::end;) {
        if (tag == Tag::head) {
            pass_head(in, result);
        } else if (tag == Tag::dataset) {
            pass_dataset(in, result.datasets.emplace_back());
        } else {
            std::string why;
            in(why);
            throw hdf5::Error(why);
        }
    }
}

/// As many values as the shape says, and a name for each dimension.
bool is_consistent(const Dataset& dataset) {
    std::size_t n = 1;
    for (const std::size_t size : dataset.shape) n *= size;
    return dataset.dims.size() == dataset.shape.size() &&
           (dataset.values.size() == n || dataset.texts.size() == n);
}

/// HDF5 takes less than a minute for gigabytes of ours.
Apart::Limits limits_for(double bytes, double most_bytes) {
    return {3 + bytes / 4e6,
            (std::size_t{1} << 28) + static_cast<std::size_t>(most_bytes)};
}

UserError refusal(const fs::path& file, const ResultFile& known, const std::string& why) {
    const bool is_ours = known.attributes.contains("program");
    return UserError(
        ExitCode::data,
        fmt::format("{}: {}: {}", file.string(),
                    is_ours ? "damaged" : "not a result of bemcal-batch", why));
}

}  // namespace

ResultFile read_apart(const fs::path& file, const std::string& group) {
    std::error_code ignored;
    const auto bytes = static_cast<double>(fs::file_size(file, ignored));
    const double most_bytes = 1e6 + 200 * bytes;
    ResultFile result;
    Apart reader(
        [&](std::FILE* out) {
            Sender sender(out);
            send_all(file, group, sender);
        },
        limits_for(bytes, most_bytes));
    try {
        Receiver receiver(reader.answer(), most_bytes);
        receive_all(receiver, result);
    } catch (const hdf5::Error& error) {
        throw refusal(file, result, error.what());
    } catch (const Broken&) {
        throw refusal(file, result, "HDF5 cannot read it: " + reader.ending());
    } catch (const std::bad_alloc&) {
        throw refusal(file, result, "there is too little memory for it");
    }
    for (const Dataset& dataset : result.datasets)
        if (!is_consistent(dataset))
            throw refusal(file, result,
                          "dataset " + dataset.path + " is not of its shape");
    return result;
}

ResultFile read_here(const fs::path& file, const std::string& group) {
    ResultFile result;
    read_all(
        file, group, [&](ResultFile head) { result = std::move(head); },
        [&](Dataset dataset) { result.datasets.push_back(std::move(dataset)); });
    return result;
}

void read_each_here(const fs::path& file,
                    const std::function<void(const ResultFile&)>& head,
                    const std::function<void(const Dataset&)>& each) {
    read_all(file, "", head, each);
}

}  // namespace bemcal::store
