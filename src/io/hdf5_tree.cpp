#include "io/hdf5_tree.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace kaya {

namespace {

/// An HDF5 object that is closed at the end of its scope.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Handle& operator=(Handle&&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }
    bool ok() const { return id_ >= 0; }

private:
    hid_t id_;
    Close close_;
};

hid_t type_of(Scalar type) {
    switch (type) {
    case Scalar::boolean:
    case Scalar::uint8: return H5T_NATIVE_UINT8;
    case Scalar::int32: return H5T_NATIVE_INT32;
    case Scalar::uint32: return H5T_NATIVE_UINT32;
    case Scalar::int64: return H5T_NATIVE_INT64;
    case Scalar::uint64: return H5T_NATIVE_UINT64;
    case Scalar::float64: return H5T_NATIVE_DOUBLE;
    }
    return H5I_INVALID_HID;
}

/// Turns off three things that HDF5 does by default. It prints its stack of errors on the terminal. It cleans up when the program ends:
/// files are in memory and closed by kaya, and after an allocation failure the clean-up crashes. It loads plugins named in the environment.
void silence() {
    H5dont_atexit(); // the first time before all else, later without effect
    H5PLset_loading_state(0);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle file_access_in_memory() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t growth = std::size_t{4} << 20;
    H5Pset_fapl_core(access, growth, 0);
    H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST); // the layout that hdf5_format.hpp reads
    return access;
}

/// HDF5 keeps its state for the process and is not made for threads: one model is saved at a time.
std::recursive_timed_mutex in_library;
constexpr std::chrono::minutes longest_wait{1};

/// HDF5 identifies files in memory by their name.
std::string unused_name() {
    static std::atomic<std::uint64_t> count{0};
    return "memory-" + std::to_string(count++);
}

/// The groups that are open, the file's root first, and the names that lead there.
class Groups {
public:
    void push(Handle group, const std::string& name) {
        open_.push_back(std::move(group));
        names_.push_back(name);
    }
    void pop() {
        open_.pop_back();
        names_.pop_back();
    }
    hid_t top() const { return open_.back(); }
    std::string path_of(const std::string& name) const {
        std::string path;
        for (std::size_t k = 1; k < names_.size(); ++k) path += names_[k] + "/";
        return path + name;
    }

private:
    std::vector<Handle> open_;
    std::vector<std::string> names_;
};

/// Whether light compression pays: integers always shrink, reals when many rows repeat the row before. Deflating noise would only slow the
/// save down.
bool worth_compressing(Scalar type, const void* numbers, std::size_t rows, std::size_t per_row) {
    constexpr std::size_t smallest = 4096; // rows below which nothing is gained
    if (rows * per_row < smallest) return false;
    if (type != Scalar::float64) return true;
    const auto* real = static_cast<const double*>(numbers);
    constexpr std::size_t probes = 1024;
    const std::size_t step = std::max<std::size_t>(1, (rows - 1) / probes);
    std::size_t seen = 0, same = 0;
    for (std::size_t row = 1; row < rows; row += step)
        for (std::size_t k = 0; k < per_row; ++k) {
            ++seen;
            same += std::memcmp(real + row * per_row + k, real + (row - 1) * per_row + k, sizeof(double)) == 0;
        }
    return 4 * same >= seen;
}

} // namespace

struct TreeWriter::Files {
    std::unique_lock<std::recursive_timed_mutex> alone;
    Handle file;
    Groups groups;
};

TreeWriter::TreeWriter() {
    std::unique_lock<std::recursive_timed_mutex> alone(in_library, longest_wait);
    if (!alone) throw TreeError("another model of this program is being saved, for more than a minute");
    silence();
    const Handle access = file_access_in_memory();
    Handle file(H5Fcreate(unused_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    if (!file.ok()) throw TreeError("no file can be made in memory");
    files_ = std::make_unique<Files>(Files{std::move(alone), std::move(file), {}});
    files_->groups.push(Handle(H5Gopen2(files_->file, "/", H5P_DEFAULT), H5Gclose), "");
}

TreeWriter::~TreeWriter() = default;

void TreeWriter::open_group(const std::string& name) {
    Handle group(H5Gcreate2(files_->groups.top(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    if (!group.ok()) throw TreeError("cannot make group " + files_->groups.path_of(name));
    files_->groups.push(std::move(group), name);
}

void TreeWriter::close_group() { files_->groups.pop(); }

void TreeWriter::attribute(const std::string& name, Scalar type, const void* numbers, std::size_t count) {
    const hsize_t size = count;
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle attribute(
        H5Acreate2(files_->groups.top(), name.c_str(), type_of(type), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute.ok() || H5Awrite(attribute, type_of(type), numbers) < 0)
        throw TreeError("cannot write " + files_->groups.path_of(name));
}

void TreeWriter::data(const std::string& name, Scalar type, const void* numbers, std::size_t rows,
                      std::size_t per_row) {
    const std::array<hsize_t, 2> size{rows, per_row};
    const Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(how, false); // the same state gives the same bytes
    if (worth_compressing(type, numbers, rows, per_row)) {
        constexpr std::size_t chunk_bytes = std::size_t{1} << 18;
        const std::size_t row_bytes = size_of(type) * per_row;
        const std::array<hsize_t, 2> chunk{std::clamp<std::size_t>(chunk_bytes / row_bytes, 1, rows), per_row};
        H5Pset_chunk(how, 2, chunk.data());
        H5Pset_shuffle(how);
        H5Pset_deflate(how, 1);
    }
    const Handle data(
        H5Dcreate2(files_->groups.top(), name.c_str(), type_of(type), space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
    if (!data.ok() || (rows > 0 && H5Dwrite(data, type_of(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) < 0))
        throw TreeError("cannot write " + files_->groups.path_of(name));
}

void TreeWriter::text(const std::string& name, const std::string& text) {
    // HDF5 has no text of length zero.
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(1, text.size()));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(how, false);
    const Handle data(H5Dcreate2(files_->groups.top(), name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
                      H5Dclose);
    if (!data.ok() || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0)
        throw TreeError("cannot write " + files_->groups.path_of(name));
}

std::string TreeWriter::image() {
    if (H5Fflush(files_->file, H5F_SCOPE_GLOBAL) < 0) throw TreeError("the file in memory cannot be completed");
    const ssize_t size = H5Fget_file_image(files_->file, nullptr, 0);
    if (size <= 0) throw TreeError("the file in memory cannot be completed");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(files_->file, bytes.data(), bytes.size()) != size)
        throw TreeError("the file in memory cannot be read");
    return bytes;
}

} // namespace kaya
