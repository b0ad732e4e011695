#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "render/raster/receivers.h"

namespace lagomorph::render::raster {

/// Where cells are smooth.
struct Smoothness {
  /// Those whose parts differ by more from their neighbours' say nothing: by a tenth, those of shadows whose
  /// edges are narrower than some ten cells.
  float most_difference;
  /// Nor do those beside such ones where little is seen, for specks in a shadow would show.
  bool dark_specks_show;
};

/// What one pixel of each cell of step x step pixels sees, to be shared by all of them where shadows are wide
/// and the surface goes on: few lookups in place of many. Between cells it is bilinear. Of each there are N
/// parts: of the lights, or of the sky's colours.
template <std::size_t N, int step>
class CoarseParts {
public:
  using Parts = std::array<float, N>;

  /// All is seen.
  explicit CoarseParts(const ReceiverBlocks& cells) : width_(cells.width), height_(cells.height) {
    const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    Parts all;
    all.fill(1.0F);
    parts_.assign(count, all);
    surfaces_.assign(count, {Vec3::UnitY(), nowhere});
    kinds_.assign(count, Kind::open);
    spreads_.assign(count, nowhere);
    hard_.assign(count, 0);
    for (const ReceiverBlock& block : cells.blocks) {
      block.for_lanes([&](std::size_t lane, int x, int y) {
        if (block.at.there[lane] != 0)
          surfaces_[index(x, y)] = {block.at.normal.at(static_cast<int>(lane)), block.at.depth[lane]};
      });
    }
  }

  Parts& at(int x, int y) { return parts_[index(x, y)]; }

  /// When all is put: finds where it is not smooth. `hard`, one a block: those beside which nothing is.
  void finish(const ReceiverBlocks& cells, const Smoothness& smooth, std::span<const LaneBits> hard) {
    for (std::size_t b = 0; b < cells.blocks.size(); ++b) {
      if (hard[b] == 0) continue;
      cells.blocks[b].for_lanes([&](std::size_t lane, int x, int y) {
        if ((hard[b] >> lane & 1) != 0) hard_[index(x, y)] = 1;
      });
    }
    for (const ReceiverBlock& block : cells.blocks) {
      block.for_lanes([&](std::size_t, int x, int y) {
        if (x + 1 >= width_ || y + 1 >= height_) return;
        kinds_[index(x, y)] = kind(x, y, smooth);
        spreads_[index(x, y)] = spread(x, y);
      });
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (kinds_[index(x, y)] == Kind::sloped && is_beside_rough(x, y)) kinds_[index(x, y)] = Kind::edge;
      }
    }
  }

  /// Whether pixel (x, y), see find(), and what is around it see all of everything.
  bool is_open(int x, int y) const { return kinds_[index(x / step, y / step)] == Kind::open; }
  /// What pixel (x, y) from that of cell (0, 0) sees; returns false where its cells do not say it: they see
  /// too different parts, or other surfaces. `depth` and `normal()` are the pixel's own, `reach` the
  /// difference in depth within which the surface goes on [m]; the normal is not asked for where the cell's
  /// corners are of one surface that is as deep as the pixel.
  template <class Normal>
  bool find(int x, int y, float depth, const Normal& normal, float reach, Parts& seen) const {
    const int cx = x / step, cy = y / step;
    const std::size_t cell = index(cx, cy);
    if (kinds_[cell] == Kind::rough || kinds_[cell] == Kind::edge) return false;
    if (kinds_[cell] == Kind::open) {
      seen.fill(1.0F);
      return true;
    }
    const float right = static_cast<float>(x % step) / static_cast<float>(step);
    const float above = static_cast<float>(y % step) / static_cast<float>(step);
    if (spreads_[cell] + std::abs(surfaces_[cell].depth - depth) <= reach) {
      const Parts &a = parts_[cell], &b = parts_[cell + 1], &c = parts_[index(cx, cy + 1)],
                  &d = parts_[index(cx + 1, cy + 1)];
      for (std::size_t k = 0; k < N; ++k) {
        const float low = a[k] + right * (b[k] - a[k]), high = c[k] + right * (d[k] - c[k]);
        seen[k] = low + above * (high - low);
      }
      return true;
    }
    seen.fill(0.0F);
    float total = 0.0F;
    const Vec3 own = normal();
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const float weight = (i == 0 ? 1.0F - right : right) * (j == 0 ? 1.0F - above : above);
        if (weight == 0.0F) continue;
        const std::size_t c = index(cx + i, cy + j);
        const Surface& s = surfaces_[c];
        if (std::abs(s.depth - depth) > reach || s.normal.dot(own) < least_alike) continue;
        for (std::size_t k = 0; k < N; ++k) seen[k] += weight * parts_[c][k];
        total += weight;
      }
    }
    if (total == 0.0F) return false;
    for (float& part : seen) part /= total;
    return true;
  }

private:
  /// Of dark cells beside those that say nothing, the difference from which on they do not either.
  static constexpr float slope = 0.01F, dark = 0.05F;
  /// Cosine of the angle from which on two normals are of different surfaces.
  static constexpr float least_alike = 0.9F, least_alike_of_cells = 0.95F;
  static constexpr float nowhere = 1e9F;

  struct Surface {
    Vec3 normal;
    float depth;  // [m]
  };
  /// With its neighbours to the right and above: all of everything is seen, or not. Of the sloped ones the
  /// edges are beside rough ones.
  enum class Kind : char { open, smooth, sloped, rough, edge };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  Kind kind(int x, int y, const Smoothness& smooth) const {
    const Parts& a = parts_[index(x, y)];
    float most = 0.0F, most_of_dark = 0.0F, least_seen = 1.0F;
    for (const std::size_t other : {index(x, y), index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)}) {
      const Parts& b = parts_[other];
      float difference = 0.0F, of_dark = 0.0F;
      for (std::size_t k = 0; k < N; ++k) {
        const float of_part = std::abs(a[k] - b[k]);
        difference = std::max(difference, of_part);
        if (smooth.dark_specks_show && std::min(a[k], b[k]) < dark) of_dark = std::max(of_dark, of_part);
        least_seen = std::min(least_seen, b[k]);
      }
      if (hard_[other] != 0) most = 1.0F;  // it may hide all
      if (surfaces_[other].depth >= nowhere) continue;
      most = std::max(most, difference);
      most_of_dark = std::max(most_of_dark, of_dark);
    }
    if (most > smooth.most_difference) return Kind::rough;
    if (most_of_dark > slope) return Kind::sloped;
    return least_seen < 1.0F ? Kind::smooth : Kind::open;
  }

  /// Of the depths at the corners of a cell that are of one surface, so that no pixel between them needs to
  /// be compared with each; else nowhere.
  float spread(int x, int y) const {
    const Surface& a = surfaces_[index(x, y)];
    float most = 0.0F;
    for (const std::size_t other : {index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)}) {
      const Surface& b = surfaces_[other];
      if (a.normal.dot(b.normal) < least_alike_of_cells) return nowhere;
      most = std::max(most, std::abs(a.depth - b.depth));
    }
    return most;
  }

  bool is_beside_rough(int x, int y) const {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); ++i) {
        if (kinds_[index(i, j)] == Kind::rough) return true;
      }
    }
    return false;
  }

  int width_, height_;
  std::vector<Parts> parts_;
  std::vector<Surface> surfaces_;
  std::vector<Kind> kinds_;
  std::vector<char> hard_;
  std::vector<float> spreads_;  // [m]
};

}  // namespace lagomorph::render::raster
