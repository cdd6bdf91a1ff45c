#pragma once

#include <memory>

#include <vtkZLibDataCompressor.h>

struct libdeflate_compressor;

namespace hexwall {

// NOLINTBEGIN(readability-identifier-naming): VTK's names

/// VTK's compressor to zlib's format, with libdeflate in the place of zlib: twice as fast. It keeps
/// the name of VTK's class, which files carry. The level, 0 … 12, must be set before its first use.
/// Blocks of which a sample hardly shrinks, as of most coordinates, are stored as they are.
class ZlibCompressor : public vtkZLibDataCompressor {
 public:
  static ZlibCompressor* New();

  std::size_t GetMaximumCompressionSpace(std::size_t size) override;

 protected:
  std::size_t CompressBuffer(const unsigned char* from, std::size_t size, unsigned char* to,
                             std::size_t space) override;

 private:
  bool is_worthwhile(const unsigned char* from, std::size_t size) const;

  struct Free {
    void operator()(libdeflate_compressor* compressor) const;
  };
  using Compressor = std::unique_ptr<libdeflate_compressor, Free>;
  Compressor deflate_, store_;
};

// NOLINTEND(readability-identifier-naming)

}  // namespace hexwall
