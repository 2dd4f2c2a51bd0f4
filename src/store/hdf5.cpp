/// Files, text attributes, arrays and dimension scales by HDF5's C interface, which this
/// file alone includes.
/// Source: HDF5's reference; netCDF-4's conventions for dimensions. Locks and time stamps
/// are off. Left out: chunks, compression, types other than doubles and texts.
#include "store/hdf5.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

namespace bemcal::store::hdf5 {
namespace {

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

/// Owns one identifier.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close close, const char* doing, const std::string& what)
        : id_(checked(id, doing, what)), close_(close) {}
    Handle(Handle&& other) noexcept
        : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
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

bool is_bare(hid_t dataset) {
    char name[128] = "";
    return H5DSis_scale(dataset) > 0 &&
           H5DSget_scale_name(dataset, name, sizeof name) > 0 &&
           std::strncmp(name, bare_mark, std::strlen(bare_mark)) == 0;
}

std::string leaf_of(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

std::string object_path(hid_t object) {
    std::string path(
        static_cast<std::size_t>(std::max<ssize_t>(0, H5Iget_name(object, nullptr, 0))),
        '\0');
    H5Iget_name(object, path.data(), path.size() + 1);
    return path;
}

/// Name of the first scale on an axis; a scale is its own.
std::string dimension_name(hid_t dataset, unsigned axis) {
    if (H5DSis_scale(dataset) > 0) return leaf_of(object_path(dataset));
    std::string name;
    H5DSiterate_scales(
        dataset, axis, nullptr,
        [](hid_t, unsigned, hid_t scale, void* out) -> herr_t {
            *static_cast<std::string*>(out) = leaf_of(object_path(scale));
            return 1;
        },
        &name);
    return name;
}

Shape shape_of(hid_t dataset) {
    const Handle space(H5Dget_space(dataset), H5Sclose, "read", "a shape");
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

std::vector<std::string> read_texts(hid_t dataset, const std::string& path,
                                    std::size_t n) {
    std::vector<char*> raw(n, nullptr);
    const Handle type = text_type();
    void* const buffer = static_cast<void*>(raw.data());
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer), "read", path);
    std::vector<std::string> texts(n);
    for (std::size_t k = 0; k < n; ++k) texts[k] = raw[k] ? raw[k] : "";
    const Handle space(H5Dget_space(dataset), H5Sclose, "read", path);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, buffer);
    return texts;
}

bool is_text(hid_t type) {
    return H5Tget_class(type) == H5T_STRING;
}

/// The text of an attribute, or nothing where it is of another type.
std::string read_attribute(hid_t attribute) {
    const Handle type = text_type();
    char* raw = nullptr;
    if (H5Aread(attribute, type, static_cast<void*>(&raw)) < 0 || !raw) return {};
    std::string text = raw;
    H5free_memory(raw);
    return text;
}

/// Errors are ours to print. No exit handler: it would write a file again whose disk was
/// full, and crash; every other file is closed by then.
void start_library() {
    [[maybe_unused]] static const herr_t without_exit_handler = H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
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
    return File(
        checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), "open", path.string()));
}

File::File(File&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

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
    const Handle group(H5Gcreate2(id_, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose, "create group", path);
}

void File::write_attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
    const Handle owner = open_object(id_, object);
    const Handle type = text_type();
    const Handle space = space_of({});
    const Handle attribute(
        H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "create attribute", name);
    const char* raw = text.c_str();
    checked(H5Awrite(attribute, type, static_cast<const void*>(&raw)), "write attribute",
            name);
}

void File::write(const std::string& path, const Shape& shape,
                 std::span<const double> values) {
    const Handle space = space_of(shape);
    const Handle dataset = make_dataset(id_, path, H5T_IEEE_F64LE, space);
    if (values.empty()) return;
    checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                     values.data()),
            "write", path);
}

void File::write(const std::string& path, const Shape& shape,
                 std::span<const std::string> texts) {
    std::vector<const char*> raw(texts.size());
    std::transform(texts.begin(), texts.end(), raw.begin(),
                   [](const std::string& text) { return text.c_str(); });
    const Handle space = space_of(shape);
    const Handle type = text_type();
    const Handle dataset = make_dataset(id_, path, type, space);
    if (raw.empty()) return;
    const void* const buffer = static_cast<const void*>(raw.data());
    checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer), "write",
            path);
}

void File::write_bare_dimension(const std::string& path, std::size_t size) {
    const Handle space = space_of({size});
    const Handle dataset = make_dataset(id_, path, H5T_IEEE_F32BE, space);
    const std::string mark = fmt::format("{}{:10}", bare_mark, size);
    checked(H5DSset_scale(dataset, mark.c_str()), "make a dimension of", path);
}

void File::make_scale(const std::string& path) {
    const Handle dataset = open_dataset(id_, path);
    checked(H5DSset_scale(dataset, leaf_of(path).c_str()), "make a dimension of", path);
}

void File::attach_scale(const std::string& path, unsigned axis,
                        const std::string& scale) {
    const Handle dataset = open_dataset(id_, path);
    const Handle dimension = open_dataset(id_, scale);
    checked(H5DSattach_scale(dataset, dimension, axis), "attach a dimension to", path);
}

std::map<std::string, std::string> File::attributes(const std::string& object) const {
    std::map<std::string, std::string> found;
    const Handle owner = open_object(id_, object);
    H5Aiterate2(
        owner, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t at, const char* name, const H5A_info_t*, void* out) -> herr_t {
            const Handle attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose, "open",
                                   name);
            const Handle type(H5Aget_type(attribute), H5Tclose, "read", name);
            if (H5Tis_variable_str(type) > 0)
                (*static_cast<std::map<std::string, std::string>*>(out))[name] =
                    read_attribute(attribute);
            return 0;
        },
        &found);
    return found;
}

std::vector<std::string> File::dataset_paths() const {
    std::vector<std::string> paths;
    H5Ovisit2(
        id_, H5_INDEX_NAME, H5_ITER_INC,
        [](hid_t at, const char* name, const H5O_info_t* info, void* out) -> herr_t {
            if (info->type == H5O_TYPE_DATASET && !is_bare(open_dataset(at, name)))
                static_cast<std::vector<std::string>*>(out)->push_back(name);
            return 0;
        },
        &paths, H5O_INFO_BASIC);
    std::sort(paths.begin(), paths.end());
    return paths;
}

Array File::read(const std::string& path) const {
    const Handle dataset = open_dataset(id_, path);
    const Handle type(H5Dget_type(dataset), H5Tclose, "read", path);
    Array array{shape_of(dataset), {}, {}, {}};
    for (unsigned axis = 0; axis < array.shape.size(); ++axis)
        array.dims.push_back(dimension_name(dataset, axis));
    const std::size_t n = size_of(array.shape);
    if (is_text(type)) {
        array.texts = read_texts(dataset, path, n);
    } else if (n > 0) {
        array.values.resize(n);
        checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                        array.values.data()),
                "read", path);
    }
    return array;
}

}  // namespace bemcal::store::hdf5
