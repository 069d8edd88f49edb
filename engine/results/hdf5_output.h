#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/results/hdf5_handle.h"

namespace burnish::inline results::hdf5 {

/// A group or dataset that is being written. A failed HDF5 call throws `std::runtime_error`: the file is in
/// memory, so nothing outside the program can be the reason.
class OutputObject {
 public:
  void attribute(const std::string& name, int value) const;
  void attribute(const std::string& name, double value) const;
  void attribute(const std::string& name, const Eigen::Vector3d& value) const;
  void attribute(const std::string& name, const std::string& value) const;
  void attribute(const std::string& name, const std::vector<std::string>& values) const;

 protected:
  explicit OutputObject(Handle object) : object_(std::move(object)) {}
  hid_t id() const { return object_.get(); }

 private:
  friend class OutputGroup;
  Handle object_;
};

class OutputGroup : public OutputObject {
 public:
  explicit OutputGroup(Handle group) : OutputObject(std::move(group)) {}

  OutputGroup group(const std::string& name) const;

  /// Dataset of shape (columns, rows): the columns of the matrix follow each other in the file.
  OutputObject dataset(const std::string& name, const Eigen::MatrixXd& values) const;
  OutputObject dataset(const std::string& name, const Eigen::VectorXd& values) const;
  OutputObject dataset(const std::string& name, const std::vector<double>& values) const;
  OutputObject dataset(const std::string& name, const std::vector<int>& values) const;
  OutputObject dataset(const std::string& name, const std::string& text) const;

 private:
  OutputObject write(const std::string& name, hid_t fileType, hid_t memoryType,
                     const std::vector<hsize_t>& shape, const void* values) const;
};

/// An HDF5 file that is built in memory and handed over as bytes, so that all writing to the disk, with its
/// errors, is in our own hands. Equal contents give equal bytes.
class OutputImage {
 public:
  OutputImage();
  ~OutputImage();

  OutputGroup root() const;

  /// The finished file. Call once, when no group or dataset of the image is open any more.
  std::vector<std::byte> finish();

 private:
  struct Buffer;
  std::unique_ptr<Buffer> buffer_;
  Handle file_;
};

}  // namespace burnish::inline results::hdf5
