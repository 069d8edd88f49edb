#include "engine/results/hdf5_output.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <stdexcept>

namespace burnish::inline results::hdf5 {
namespace {

constexpr hsize_t kLargestCompactDataset = 8 << 10;  // bytes; HDF5 allows just under 64 KiB
constexpr hsize_t kChunkSize = 1 << 20;              // bytes, the size of HDF5's chunk cache
constexpr unsigned kDeflateLevel = 1;  // higher levels gain a few percent and cost several times as long

hid_t checked(hid_t id) {
  if (id < 0) throw std::runtime_error("HDF5 could not create an object in memory");
  return id;
}

void check(herr_t status) {
  if (status < 0) throw std::runtime_error("HDF5 could not write to memory");
}

Handle propertyList(hid_t propertyClass) {
  return {checked(H5Pcreate(propertyClass)), H5Pclose};
}

Handle dataspace(std::span<const hsize_t> shape) {
  if (shape.empty()) return {checked(H5Screate(H5S_SCALAR)), H5Sclose};
  return {checked(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr)), H5Sclose};
}

/// Fixed length, because strings of variable length lie in a heap that has no checksum.
Handle stringType(std::size_t length) {
  Handle type(checked(H5Tcopy(H5T_C_S1)), H5Tclose);
  check(H5Tset_size(type.get(), std::max<std::size_t>(length, 1)));
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8));
  return type;
}

void writeAttribute(hid_t object, const std::string& name, hid_t fileType, hid_t memoryType,
                    std::span<const hsize_t> shape, const void* values) {
  const Handle space = dataspace(shape);
  const Handle attribute(
      checked(H5Acreate2(object, name.c_str(), fileType, space.get(), H5P_DEFAULT, H5P_DEFAULT)), H5Aclose);
  check(H5Awrite(attribute.get(), memoryType, values));
}

/// Small datasets lie in their (checksummed) header; larger ones are compressed in chunks with a checksum
/// each.
Handle datasetLayout(std::span<const hsize_t> shape, hsize_t itemSize) {
  Handle properties = propertyList(H5P_DATASET_CREATE);
  check(H5Pset_obj_track_times(properties.get(), false));
  hsize_t rowSize = itemSize;
  for (std::size_t d = 1; d < shape.size(); ++d) rowSize *= shape[d];
  const hsize_t rows = shape.empty() ? 1 : shape[0];
  if (rows * rowSize <= kLargestCompactDataset) {
    check(H5Pset_layout(properties.get(), H5D_COMPACT));
  } else if (!shape.empty()) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    chunk[0] = std::clamp<hsize_t>(kChunkSize / rowSize, 1, rows);
    check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()));
    check(H5Pset_shuffle(properties.get()));
    check(H5Pset_deflate(properties.get(), kDeflateLevel));
  }
  return properties;
}

hsize_t extent(Eigen::Index n) {
  return static_cast<hsize_t>(n);
}

}  // namespace

void OutputObject::attribute(const std::string& name, int value) const {
  writeAttribute(id(), name, H5T_STD_I32LE, H5T_NATIVE_INT, {}, &value);
}

void OutputObject::attribute(const std::string& name, double value) const {
  writeAttribute(id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void OutputObject::attribute(const std::string& name, const Eigen::Vector3d& value) const {
  const hsize_t shape = 3;
  writeAttribute(id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {&shape, 1}, value.data());
}

void OutputObject::attribute(const std::string& name, const std::string& value) const {
  const Handle type = stringType(value.size());
  writeAttribute(id(), name, type.get(), type.get(), {}, value.c_str());
}

void OutputObject::attribute(const std::string& name, const std::vector<std::string>& values) const {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string padded(std::max<std::size_t>(values.size(), 1) * length, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(padded.data() + i * length, length);
  const Handle type = stringType(length);
  const hsize_t shape = values.size();
  writeAttribute(id(), name, type.get(), type.get(), {&shape, 1}, padded.data());
}

OutputGroup OutputGroup::group(const std::string& name) const {
  const Handle properties = propertyList(H5P_GROUP_CREATE);
  check(H5Pset_obj_track_times(properties.get(), false));
  return OutputGroup(
      {checked(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT)), H5Gclose});
}

OutputObject OutputGroup::write(const std::string& name, hid_t fileType, hid_t memoryType,
                                const std::vector<hsize_t>& shape, const void* values) const {
  const Handle space = dataspace(shape);
  const Handle layout = datasetLayout(shape, H5Tget_size(fileType));
  Handle dataset(
      checked(H5Dcreate2(id(), name.c_str(), fileType, space.get(), H5P_DEFAULT, layout.get(), H5P_DEFAULT)),
      H5Dclose);
  if (values) check(H5Dwrite(dataset.get(), memoryType, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  return OutputObject(std::move(dataset));
}

OutputObject OutputGroup::dataset(const std::string& name, const Eigen::MatrixXd& values) const {
  return write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {extent(values.cols()), extent(values.rows())},
               values.data());
}

OutputObject OutputGroup::dataset(const std::string& name, const Eigen::VectorXd& values) const {
  return write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {extent(values.size())}, values.data());
}

OutputObject OutputGroup::dataset(const std::string& name, const std::vector<double>& values) const {
  return write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

OutputObject OutputGroup::dataset(const std::string& name, const std::vector<int>& values) const {
  return write(name, H5T_STD_I32LE, H5T_NATIVE_INT, {values.size()}, values.data());
}

OutputObject OutputGroup::dataset(const std::string& name, const std::string& text) const {
  const Handle type = stringType(text.size());
  return write(name, type.get(), type.get(), {}, text.c_str());
}

/// Keeps the memory of HDF5's core driver when the file is closed: only then is the image consistent (what
/// H5Fget_file_image of HDF5 1.10 returns has a superblock with a stale checksum).
struct OutputImage::Buffer {
  void* data = nullptr;
  std::size_t size = 0;

  ~Buffer() { std::free(data); }

  static void* allocate(std::size_t size, H5FD_file_image_op_t, void* self) {
    auto& buffer = *static_cast<Buffer*>(self);
    buffer.data = std::calloc(1, size);
    buffer.size = size;
    return buffer.data;
  }

  static void* reallocate(void* data, std::size_t size, H5FD_file_image_op_t, void* self) {
    auto& buffer = *static_cast<Buffer*>(self);
    void* grown = std::realloc(data, size);
    if (!grown) return nullptr;
    buffer.data = grown;
    // Gaps that HDF5 leaves between its objects reach the disk: they must hold zeros, not old memory.
    if (size > buffer.size) std::memset(static_cast<char*>(grown) + buffer.size, 0, size - buffer.size);
    buffer.size = size;
    return grown;
  }

  static herr_t keep(void*, H5FD_file_image_op_t, void*) { return 0; }
  static void* share(void* self) { return self; }
  static herr_t unshare(void*) { return 0; }
};

namespace {

/// HDF5 first looks for a file of the name, and reads all of it: one that there can be nowhere.
constexpr const char* kNoFile = "/dev/null/burnish";

Handle createInMemory(H5FD_file_image_callbacks_t callbacks) {
  silenceErrors();
  const Handle access = propertyList(H5P_FILE_ACCESS);
  check(H5Pset_fapl_core(access.get(), kChunkSize, false));
  check(H5Pset_file_image_callbacks(access.get(), &callbacks));
  // Space in advance for metadata would be cut off on closing, after the size of the image is known.
  check(H5Pset_meta_block_size(access.get(), 0));
  // The newest format of HDF5 1.10 has a checksum on every piece of metadata.
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110));
  const Handle creation = propertyList(H5P_FILE_CREATE);
  check(H5Pset_obj_track_times(creation.get(), false));
  return {checked(H5Fcreate(kNoFile, H5F_ACC_TRUNC, creation.get(), access.get())), H5Fclose};
}

}  // namespace

OutputImage::OutputImage()
    : buffer_(std::make_unique<Buffer>()),
      file_(createInMemory({Buffer::allocate, nullptr, Buffer::reallocate, Buffer::keep, Buffer::share,
                            Buffer::unshare, buffer_.get()})) {}

OutputImage::~OutputImage() = default;

OutputGroup OutputImage::root() const {
  return OutputGroup({checked(H5Gopen2(file_.get(), "/", H5P_DEFAULT)), H5Gclose});
}

std::vector<std::byte> OutputImage::finish() {
  check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
  if (size < 0) throw std::runtime_error("HDF5 could not tell the size of a file in memory");
  check(H5Fclose(file_.release()));
  const auto* begin = static_cast<const std::byte*>(buffer_->data);
  return {begin, begin + size};
}

}  // namespace burnish::inline results::hdf5
