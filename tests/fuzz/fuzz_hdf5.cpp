/// libFuzzer's way into what HDF5 hands us: files that are sound for HDF5 and odd for us,
/// of any types, shapes, attributes and links, read in this process.
#include "fuzz/result_targets.hpp"
#include "store/hdf5.hpp"
#include "store/result_reading.hpp"
#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <hdf5.h>

namespace {

using bemcal::fuzz::Choices;

constexpr const char* object_names[] = {"run",
                                        "a",
                                        "a/sa",
                                        "a/sa/output",
                                        "a/sa/parameter",
                                        "a/sa/total_order",
                                        "b",
                                        "b/p",
                                        "b/p/posterior",
                                        "b/p/posterior/u",
                                        "b/p/unknown",
                                        "stock",
                                        "stock/stock_building",
                                        "stock/stock_fits_of",
                                        "stock/stock_daily_n"};
constexpr const char* attribute_names[] = {
    "program", "title", "job",  "seed",           "COMPLETE",       "result_hash",
    "units",   "CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "long_name"};

hid_t variable_text() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
}

hid_t fixed_text(std::size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    return type;
}

hid_t compound(std::size_t size) {
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    H5Tinsert(type, "a", 0, H5T_NATIVE_DOUBLE);
    return type;
}

hid_t some_type(Choices& choices) {
    switch (choices.below(12)) {
        case 0:
            return H5Tcopy(H5T_NATIVE_DOUBLE);
        case 1:
            return H5Tcopy(H5T_IEEE_F32BE);
        case 2:
            return H5Tcopy(H5T_STD_I8LE);
        case 3:
            return H5Tcopy(H5T_STD_U64BE);
        case 4:
            return fixed_text(1 + choices.below(3000));
        case 5:
            return compound(8 + choices.below(300));
        case 6:
            return H5Tvlen_create(H5T_STD_REF_OBJ);
        case 7:
            return H5Tvlen_create(H5T_NATIVE_DOUBLE);
        case 8:
            return H5Tcopy(H5T_STD_REF_OBJ);
        case 9:
            return H5Tenum_create(H5T_NATIVE_INT);
        case 10:
            return H5Tcreate(H5T_OPAQUE, 1 + choices.below(100));
        default:
            return variable_text();
    }
}

hid_t some_space(Choices& choices) {
    static const hsize_t sizes[] = {0, 1, 2, 3, 16, 200, 1ULL << 40};
    const std::size_t rank = choices.below(5);
    if (rank == 4) return H5Screate(choices.below(2) == 0 ? H5S_NULL : H5S_SCALAR);
    std::vector<hsize_t> shape(rank);
    for (hsize_t& size : shape) size = choices.one_of(sizes);
    return rank == 0 ? H5Screate(H5S_SCALAR)
                     : H5Screate_simple(static_cast<int>(rank), shape.data(), nullptr);
}

/// Bytes that are a value of any of the types that hold no pointers.
const std::vector<char>& zeros() {
    static const std::vector<char> bytes(1 << 20, 0);
    return bytes;
}

bool fits(hid_t type, hid_t space) {
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    return n >= 0 && static_cast<double>(n) * static_cast<double>(H5Tget_size(type)) <
                         static_cast<double>(zeros().size());
}

/// Texts where it holds texts, else zeros.
std::vector<const char*> texts_for(hid_t space) {
    return std::vector<const char*>(
        static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), "text");
}

void add_attribute(hid_t file, Choices& choices) {
    const std::string object = choices.below(2) == 0 ? "/" : choices.one_of(object_names);
    const hid_t owner = H5Oopen(file, object.c_str(), H5P_DEFAULT);
    const hid_t type = some_type(choices), space = some_space(choices);
    const char* name = choices.one_of(attribute_names);
    if (owner >= 0 && fits(type, space) && H5Aexists(owner, name) > 0)
        H5Adelete(owner, name);
    const hid_t attribute =
        owner >= 0 && fits(type, space)
            ? H5Acreate2(owner, name, type, space, H5P_DEFAULT, H5P_DEFAULT)
            : H5I_INVALID_HID;
    if (attribute >= 0 && choices.below(4) != 0) {
        if (H5Tis_variable_str(type) > 0)
            H5Awrite(attribute, type, texts_for(space).data());
        else
            H5Awrite(attribute, type, zeros().data());
    }
    if (attribute >= 0) H5Aclose(attribute);
    if (owner >= 0) H5Oclose(owner);
    H5Sclose(space);
    H5Tclose(type);
}

void add_dataset(hid_t file, hid_t links, Choices& choices) {
    const hid_t type = some_type(choices), space = some_space(choices);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank > 0 && choices.below(3) == 0) {
        const std::vector<hsize_t> chunk(static_cast<std::size_t>(rank), 8);
        H5Pset_chunk(creation, rank, chunk.data());
    } else if (rank > 0 && choices.below(8) == 1) {
        H5Pset_external(creation, "/nonexistent", 0, H5F_UNLIMITED);
    }
    const hid_t dataset = H5Dcreate2(file, choices.one_of(object_names), type, space,
                                     links, creation, H5P_DEFAULT);
    const bool is_own = H5Pget_external_count(creation) == 0;
    if (dataset >= 0 && is_own && fits(type, space) && choices.below(3) != 0) {
        if (H5Tis_variable_str(type) > 0)
            H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                     texts_for(space).data());
        else
            H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros().data());
    }
    if (dataset >= 0) H5Dclose(dataset);
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
}

void add_link(hid_t file, hid_t links, Choices& choices) {
    const char *from = choices.one_of(object_names), *to = choices.one_of(object_names);
    switch (choices.below(3)) {
        case 0:
            H5Lcreate_hard(file, to, file, from, links, H5P_DEFAULT);
            break;
        case 1:
            H5Lcreate_soft(to, file, from, links, H5P_DEFAULT);
            break;
        default:
            H5Lcreate_external("/nonexistent", to, file, from, links, H5P_DEFAULT);
    }
}

void write_program(hid_t file) {
    const hid_t type = variable_text(), space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(file, "program", type, space, H5P_DEFAULT, H5P_DEFAULT);
    const char* text = "bemcal-batch";
    H5Awrite(attribute, type, &text);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

void write_odd(const std::string& path, Choices& choices) {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    write_program(file);
    for (int n = 0; n < 16 && !choices.is_over(); ++n) switch (choices.below(4)) {
            case 0:
                add_attribute(file, choices);
                break;
            case 1:
                add_link(file, links, choices);
                break;
            default:
                add_dataset(file, links, choices);
        }
    H5Pclose(links);
    H5Fclose(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bemcal::test::TemporaryFolder folder;
    static const std::string path = (folder / "odd.h5").string();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    Choices choices({data, size});
    write_odd(path, choices);
    try {
        bemcal::fuzz::try_result(bemcal::store::read_here(path, ""));
    } catch (const bemcal::store::hdf5::Error&) {
    } catch (const bemcal::UserError&) {
    }
    return 0;
}
