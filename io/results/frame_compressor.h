// zlib for the arrays of a frame.

#pragma once

class vtkDataCompressor;

namespace billet::io {

/// How hard zlib tries. Runs alone take half the time of repeats, and in a small frame a twentieth
/// more room; a large one, where repeats take a quarter off, is worth the search.
enum class CompressorSearch { runs, repeats };

/// A compressor like VTK's own, its files the same to every reader. It keeps zlib's working memory:
/// a frame of a plane mesh has some forty arrays, most of them short, and VTK's sets it up anew for
/// each.
[[nodiscard]] vtkDataCompressor& frame_compressor(CompressorSearch search);

} // namespace billet::io
