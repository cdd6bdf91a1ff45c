#include "exporters/zlib_compressor.h"

#include <libdeflate.h>

#include <vtkObjectFactory.h>

namespace hexwall {

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
  if (!deflate_) return 0;  // VTK's sign of failure
  return libdeflate_zlib_compress(deflate_.get(), from, size, to, space);
}

}  // namespace hexwall
