#include "exporters/zlib_compressor.h"

#include <libdeflate.h>
#include <vector>

#include <vtkObjectFactory.h>

namespace hexwall {
namespace {

// Bytes in the middle of a block that tell whether it shrinks, and by how much it must to be worth
// the time.
constexpr std::size_t sample_size = 16384;
constexpr double least_gain = 0.15;

}  // namespace

vtkStandardNewMacro(ZlibCompressor);

void ZlibCompressor::Free::operator()(libdeflate_compressor* compressor) const {
  libdeflate_free_compressor(compressor);
}

std::size_t ZlibCompressor::GetMaximumCompressionSpace(std::size_t size) {
  return libdeflate_zlib_compress_bound(nullptr, size);
}

std::size_t ZlibCompressor::CompressBuffer(const unsigned char* from, std::size_t size,
                                           unsigned char* to, std::size_t space) {
  if (!deflate_) deflate_.reset(libdeflate_alloc_compressor(GetCompressionLevel()));
  if (!store_) store_.reset(libdeflate_alloc_compressor(0));
  if (!deflate_ || !store_) return 0;  // VTK's sign of failure
  const Compressor& chosen = is_worthwhile(from, size) ? deflate_ : store_;
  return libdeflate_zlib_compress(chosen.get(), from, size, to, space);
}

bool ZlibCompressor::is_worthwhile(const unsigned char* from, std::size_t size) const {
  if (size <= sample_size) return true;
  // Without room for more, the compressor gives up.
  std::vector<unsigned char> room(
      static_cast<std::size_t>((1.0 - least_gain) * static_cast<double>(sample_size)));
  const unsigned char* middle = from + (size - sample_size) / 2;
  return libdeflate_deflate_compress(deflate_.get(), middle, sample_size, room.data(),
                                     room.size()) > 0;
}

}  // namespace hexwall
