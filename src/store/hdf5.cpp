/// Files, text attributes, arrays and dimension scales by HDF5's C interface, which this
/// file alone includes.
/// Source: HDF5's reference; netCDF-4's conventions for dimensions. Locks and time stamps
/// are off. Marks and scales of a file that is read are looked at by hand: HDF5's own
/// functions for them trust their types and shapes.
/// Left out: chunks, compression, types other than doubles and texts.
#include "store/hdf5.hpp"

#include "store/dataset_path.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <hdf5_hl.h>

namespace bemcal::store::hdf5 {
namespace {

/// A packed file may unfold to so many times its size.
constexpr double most_packing = 100;
/// Longest text that HDF5's own conventions mark an object by.
constexpr std::size_t longest_mark = 200;

/// What netCDF-4 writes into a dimension that has no values of its own.
constexpr const char* bare_mark = "This is a netCDF dimension but not a netCDF variable.";

std::string last_error() {
    std::string text;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
            auto& said = *static_cast<std::string*>(out);
            if (said.empty() && error->desc) said = error->desc;
            return 0;
        },
        &text);
    text = text.substr(0, text.find(": time = "));  // then come buffers and offsets
    return text.empty() ? "no reason given" : text;
}

template <class Result>
Result checked(Result result, const char* doing, const std::string& what) {
    if (result < 0) throw Error(fmt::format("{} {}: {}", doing, what, last_error()));
    return result;
}

/// Owns one identifier. A dataset is written when it is closed: `close` says whether that
/// went well.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close closing, const char* doing, const std::string& what)
        : id_(checked(id, doing, what)), close_(closing) {}
    Handle(Handle&& other) noexcept
        : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    void close(const std::string& what) {
        checked(close_(std::exchange(id_, H5I_INVALID_HID)), "close", what);
    }
    Handle& operator=(Handle&&) = delete;
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make", "a text type");
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

Handle space_of(const Shape& shape) {
    if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "make", "a scalar space"};
    const std::vector<hsize_t> sizes(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
            H5Sclose, "make", "a space"};
}

Handle link_properties() {
    Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make", "link properties");
    H5Pset_create_intermediate_group(properties, 1);
    H5Pset_char_encoding(properties, H5T_CSET_UTF8);
    return properties;
}

Handle file_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make", "access properties");
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    H5Pset_file_locking(access, false, true);
    return access;
}

Handle make_dataset(hid_t file, const std::string& path, hid_t type, hid_t space) {
    const Handle links = link_properties();
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make", path);
    H5Pset_obj_track_times(creation, false);
    return {H5Dcreate2(file, path.c_str(), type, space, links, creation, H5P_DEFAULT),
            H5Dclose, "create dataset", path};
}

Handle open_dataset(hid_t file, const std::string& path) {
    return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "open dataset", path};
}

Handle open_object(hid_t file, const std::string& path) {
    return {H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose, "open", path};
}

/// A short text of fixed size, as HDF5's own conventions have them; "" where there is
/// none.
std::string mark_of(hid_t object, const char* name) {
    if (H5Aexists(object, name) <= 0) return {};
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "open", name);
    const Handle type(H5Aget_type(attribute), H5Tclose, "read", name);
    const Handle space(H5Aget_space(attribute), H5Sclose, "read", name);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_npoints(space) != 1)
        return {};
    std::string text(std::min<std::size_t>(H5Tget_size(type), longest_mark) + 1, '\0');
    if (H5Tget_size(type) > longest_mark || H5Aread(attribute, type, text.data()) < 0)
        return {};
    return text.c_str();
}

bool is_scale(hid_t dataset) {
    return mark_of(dataset, "CLASS") == "DIMENSION_SCALE";
}

bool is_bare(hid_t dataset) {
    return is_scale(dataset) && mark_of(dataset, "NAME").starts_with(bare_mark);
}

/// What a dataset says of the scales on its axes: lists of references.
class ScaleLists {
  public:
    ScaleLists(hid_t dataset, const std::string& path, std::size_t rank)
        : lists_(rank),
          attribute_(H5Aopen(dataset, attribute_name, H5P_DEFAULT), H5Aclose, "open",
                     path),
          space_(H5Aget_space(attribute_), H5Sclose, "read", path),
          type_(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, "make", "a type of lists") {
        const Handle stored(H5Aget_type(attribute_), H5Tclose, "read", path);
        if (H5Sget_simple_extent_npoints(space_) != static_cast<hssize_t>(rank) ||
            H5Tget_class(stored) != H5T_VLEN)
            throw Error(fmt::format("dataset {} has damaged dimensions", path));
        checked(H5Aread(attribute_, type_, lists_.data()), "read dimensions of", path);
    }
    ~ScaleLists() { H5Dvlen_reclaim(type_, space_, H5P_DEFAULT, lists_.data()); }
    ScaleLists(const ScaleLists&) = delete;
    ScaleLists& operator=(const ScaleLists&) = delete;

    static bool are_in(hid_t dataset) { return H5Aexists(dataset, attribute_name) > 0; }
    /// Of the first scale on an axis; "" where there is none.
    std::string name(const ScaleNames& names, std::size_t axis,
                     const std::string& path) const {
        if (lists_[axis].len == 0 || lists_[axis].p == nullptr) return {};
        const auto found = names.find(*static_cast<const hobj_ref_t*>(lists_[axis].p));
        if (found == names.end())
            throw Error(fmt::format("dataset {} has damaged dimensions", path));
        return found->second;
    }

  private:
    static constexpr const char* attribute_name = "DIMENSION_LIST";
    std::vector<hvl_t> lists_;
    Handle attribute_, space_, type_;
};

/// Names of the first scale on each axis; a scale is its own.
std::vector<std::string> dimension_names(hid_t dataset, const std::string& path,
                                         std::size_t rank, const ScaleNames& scales) {
    if (is_scale(dataset)) return std::vector<std::string>(rank, leaf_of(path));
    std::vector<std::string> names(rank);
    if (rank == 0 || !ScaleLists::are_in(dataset)) return names;
    const ScaleLists lists(dataset, path, rank);
    for (std::size_t axis = 0; axis < rank; ++axis)
        names[axis] = lists.name(scales, axis, path);
    return names;
}

Shape shape_of(hid_t dataset, const std::string& path) {
    const Handle space(H5Dget_space(dataset), H5Sclose, "read", path);
    if (H5Sget_simple_extent_type(space) == H5S_NULL)
        throw Error(fmt::format("dataset {} has no shape", path));
    std::vector<hsize_t> sizes(
        static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    if (!sizes.empty()) H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    return {sizes.begin(), sizes.end()};
}

std::size_t size_of(const Shape& shape) {
    std::size_t size = 1;
    for (const std::size_t n : shape) size *= n;
    return size;
}

/// Memory for texts of a file, which are no longer all together than the file; without
/// it HDF5 would take any length for true.
class TextMemory {
  public:
    explicit TextMemory(double most) : left_(most) {}
    static void* allocate(std::size_t size, void* self) {
        return static_cast<TextMemory*>(self)->one_of(size);
    }
    static void keep(void*, void*) {}  ///< freed with all

  private:
    void* one_of(std::size_t size) {
        if (static_cast<double>(size) > left_) return nullptr;
        left_ -= static_cast<double>(size);
        try {
            return texts_.emplace_back(std::make_unique<char[]>(size)).get();
        } catch (const std::bad_alloc&) {
            return nullptr;
        }
    }

    double left_;
    std::vector<std::unique_ptr<char[]>> texts_;
};

std::vector<std::string> read_texts(hid_t dataset, const std::string& path, std::size_t n,
                                    double most_bytes) {
    std::vector<char*> raw(n, nullptr);
    TextMemory memory(most_bytes + static_cast<double>(n));
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "make", path);
    H5Pset_vlen_mem_manager(transfer, TextMemory::allocate, &memory, TextMemory::keep,
                            &memory);
    checked(H5Dread(dataset, text_type(), H5S_ALL, H5S_ALL, transfer,
                    static_cast<void*>(raw.data())),
            "read", path);
    std::vector<std::string> texts(n);
    for (std::size_t k = 0; k < n; ++k) texts[k] = raw[k] ? raw[k] : "";
    return texts;
}

/// Throws Error where the values are neither numbers nor texts of our kind.
bool is_text(hid_t type, const std::string& path) {
    const H5T_class_t kind = H5Tget_class(type);
    const bool is_number = kind == H5T_FLOAT || kind == H5T_INTEGER;
    if (!is_number && H5Tis_variable_str(type) <= 0)
        throw Error(
            fmt::format("dataset {} holds neither numbers nor texts of variable "
                        "length",
                        path));
    return !is_number;
}

/// How much larger an array may be than the file: not at all, but for packed ones.
double packing_of(hid_t dataset, const std::string& path) {
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose, "read", path);
    const H5D_layout_t layout = H5Pget_layout(creation);
    if (layout == H5D_VIRTUAL || H5Pget_external_count(creation) != 0)
        throw Error(fmt::format("dataset {} lies in another file", path));
    return layout == H5D_CHUNKED ? most_packing : 1;
}

std::string in_words(const Shape& shape) {
    return fmt::format("({})", fmt::join(shape, ", "));
}

std::string read_attribute(hid_t attribute, const std::string& name) {
    const Handle space(H5Aget_space(attribute), H5Sclose, "read", name);
    if (H5Sget_simple_extent_npoints(space) != 1)
        throw Error(fmt::format("attribute {} is not one text", name));
    char* raw = nullptr;
    checked(H5Aread(attribute, text_type(), static_cast<void*>(&raw)), "read attribute",
            name);
    const std::string text = raw ? raw : "";
    H5free_memory(raw);
    return text;
}

/// Errors are ours to print. No exit handler: it would write a file again whose disk was
/// full, and crash; every other file is closed by then.
void start_library() {
    [[maybe_unused]] static const herr_t without_exit_handler = H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5Lunregister(H5L_TYPE_EXTERNAL);  // no file leads us to another
    H5PLset_loading_state(0);          // nor to code
}

}  // namespace

File File::create(const std::filesystem::path& path) {
    start_library();
    const Handle access = file_access();
    return File(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access),
                        "create", path.string()));
}

File File::open(const std::filesystem::path& path) {
    start_library();
    const Handle access = file_access();
    std::error_code ignored;
    const auto size = static_cast<double>(std::filesystem::file_size(path, ignored));
    return File(
        checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), "open", path.string()),
        size);
}

File::File(File&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      size_(other.size_),
      taken_(other.taken_),
      scales_(std::move(other.scales_)) {}

File::~File() {
    if (id_ >= 0) H5Fclose(id_);
}

void File::flush() {
    checked(H5Fflush(id_, H5F_SCOPE_GLOBAL), "flush", "the file");
}

void File::close() {
    flush();
    checked(H5Fclose(std::exchange(id_, -1)), "close", "the file");
}

bool File::has(const std::string& path) const {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
        if (H5Lexists(id_, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
        if (end == std::string::npos) return true;
    }
}

void File::make_group(const std::string& path) {
    if (has(path)) return;
    const Handle links = link_properties();
    Handle group(H5Gcreate2(id_, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                 "create group", path);
    group.close(path);
}

void File::write_attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
    Handle owner = open_object(id_, object);
    const Handle type = text_type();
    const Handle space = space_of({});
    Handle attribute(
        H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "create attribute", name);
    const char* raw = text.c_str();
    checked(H5Awrite(attribute, type, static_cast<const void*>(&raw)), "write attribute",
            name);
    attribute.close(name);
    owner.close(object);
}

void File::write(const std::string& path, const Shape& shape,
                 std::span<const double> values) {
    const Handle space = space_of(shape);
    Handle dataset = make_dataset(id_, path, H5T_IEEE_F64LE, space);
    if (!values.empty())
        checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         values.data()),
                "write", path);
    dataset.close(path);
}

void File::write(const std::string& path, const Shape& shape,
                 std::span<const std::string> texts) {
    std::vector<const char*> raw(texts.size());
    std::transform(texts.begin(), texts.end(), raw.begin(),
                   [](const std::string& text) { return text.c_str(); });
    const Handle space = space_of(shape);
    const Handle type = text_type();
    Handle dataset = make_dataset(id_, path, type, space);
    const void* const buffer = static_cast<const void*>(raw.data());
    if (!raw.empty())
        checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer), "write",
                path);
    dataset.close(path);
}

void File::write_bare_dimension(const std::string& path, std::size_t size) {
    const Handle space = space_of({size});
    Handle dataset = make_dataset(id_, path, H5T_IEEE_F32BE, space);
    const std::string mark = fmt::format("{}{:10}", bare_mark, size);
    checked(H5DSset_scale(dataset, mark.c_str()), "make a dimension of", path);
    dataset.close(path);
}

void File::make_scale(const std::string& path) {
    Handle dataset = open_dataset(id_, path);
    checked(H5DSset_scale(dataset, leaf_of(path).c_str()), "make a dimension of", path);
    dataset.close(path);
}

void File::attach_scale(const std::string& path, unsigned axis,
                        const std::string& scale) {
    Handle dataset = open_dataset(id_, path);
    Handle dimension = open_dataset(id_, scale);
    checked(H5DSattach_scale(dataset, dimension, axis), "attach a dimension to", path);
    dimension.close(scale);
    dataset.close(path);
}

std::map<std::string, std::string> File::attributes(const std::string& object) const {
    std::vector<std::string> names;
    const Handle owner = open_object(id_, object);
    checked(H5Aiterate2(
                owner, H5_INDEX_NAME, H5_ITER_INC, nullptr,
                [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
                    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
                    return 0;
                },
                &names),
            "read attributes of", object);
    std::map<std::string, std::string> found;
    for (const std::string& name : names) {
        const Handle attribute(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose,
                               "open attribute", name);
        const Handle type(H5Aget_type(attribute), H5Tclose, "read attribute", name);
        if (H5Tis_variable_str(type) > 0) found[name] = read_attribute(attribute, name);
    }
    return found;
}

namespace {

/// Also of dimensions without values.
std::vector<std::string> all_datasets(hid_t file) {
    std::vector<std::string> paths;
    checked(H5Ovisit2(
                file, H5_INDEX_NAME, H5_ITER_INC,
                [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
                    if (info->type == H5O_TYPE_DATASET)
                        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
                    return 0;
                },
                &paths, H5O_INFO_BASIC),
            "list", "the datasets");
    return paths;
}

}  // namespace

std::vector<std::string> File::dataset_paths() const {
    std::vector<std::string> paths = all_datasets(id_);
    std::erase_if(
        paths, [&](const std::string& path) { return is_bare(open_dataset(id_, path)); });
    std::sort(paths.begin(), paths.end());
    return paths;
}

const ScaleNames& File::scale_names() {
    if (!scales_.empty()) return scales_;
    for (const std::string& path : all_datasets(id_)) {
        hobj_ref_t reference = 0;
        checked(H5Rcreate(&reference, id_, path.c_str(), H5R_OBJECT, -1), "refer to",
                path);
        scales_[reference] = leaf_of(path);
    }
    return scales_;
}

void File::take(const std::string& path, const Shape& shape, double bytes, double most) {
    double longest = 0;
    for (const std::size_t size : shape) {
        bytes *= static_cast<double>(size);
        longest = std::max(longest, static_cast<double>(size));
    }
    taken_ += bytes;
    if (std::max(bytes, longest) > most * size_ || taken_ > most_packing * size_)
        throw Error(fmt::format("dataset {} has shape {}, more than the file can hold",
                                path, in_words(shape)));
}

Array File::read(const std::string& path) {
    const Handle dataset = open_dataset(id_, path);
    const Handle type(H5Dget_type(dataset), H5Tclose, "read", path);
    const bool has_texts = is_text(type, path);
    Array array{shape_of(dataset, path), {}, {}, {}};
    take(path, array.shape, static_cast<double>(H5Tget_size(type)),
         packing_of(dataset, path));
    array.dims = dimension_names(dataset, path, array.shape.size(), scale_names());
    const std::size_t n = size_of(array.shape);
    if (has_texts) {
        array.texts = read_texts(dataset, path, n, size_);
    } else if (n > 0) {
        array.values.resize(n);
        checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                        array.values.data()),
                "read", path);
    }
    return array;
}

}  // namespace bemcal::store::hdf5
