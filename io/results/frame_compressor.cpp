#include "io/results/frame_compressor.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkZLibDataCompressor.h>
#include <zlib.h>

#include <new>

namespace billet::io {

namespace {

class FrameCompressor : public vtkZLibDataCompressor { // whose name stands in the files
public:
  static FrameCompressor* New();

  void set_search(CompressorSearch search) {
    deflateReset(&stream_);
    deflateParams(&stream_, Z_BEST_SPEED,
                  search == CompressorSearch::runs ? Z_RLE : Z_DEFAULT_STRATEGY);
  }

protected:
  FrameCompressor() {
    if (deflateInit(&stream_, Z_BEST_SPEED) != Z_OK)
      throw std::bad_alloc();
  }
  ~FrameCompressor() override { deflateEnd(&stream_); }

  size_t CompressBuffer(const unsigned char* plain,
                        size_t plain_size,
                        unsigned char* packed,
                        size_t packed_space) override {
    deflateReset(&stream_);
    stream_.next_in = const_cast<unsigned char*>(plain); // which zlib only reads
    stream_.avail_in = static_cast<uInt>(plain_size);    // a block, at most 32 KiB
    stream_.next_out = packed;
    stream_.avail_out = static_cast<uInt>(packed_space);
    return deflate(&stream_, Z_FINISH) == Z_STREAM_END ? stream_.total_out : 0; // 0: an error
  }

private:
  z_stream stream_{};
};

vtkStandardNewMacro(FrameCompressor);

} // namespace

vtkDataCompressor& frame_compressor(CompressorSearch search) {
  static const vtkNew<FrameCompressor> compressor;
  compressor->set_search(search);
  return *compressor;
}

} // namespace billet::io
