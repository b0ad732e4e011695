#pragma once

#include <map>
#include <optional>
#include <string>

#include "apps/pipeline/frames.h"
#include "apps/pipeline/views.h"
#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"

namespace lagomorph::apps {

/// Writes frames: the state, then picture and channels, then the record of both. Safe to use from many
/// threads, each with frames of its own.
class FrameWriter {
public:
  /// `records` are those of the frames that are there. Makes the folders.
  FrameWriter(const RunPaths&, const Identity&, const SceneDesc&, const std::map<int, FrameRecord>& records,
              const Views&, bool draws);

  /// Of a frame that was drawn, its picture and the SHA-256 of its file.
  struct Written {
    render::Picture picture;
    std::string sha256;
  };
  std::optional<Written> write(const DrawnFrame&) const;

private:
  StateRecord write_state(const sim::State&, StateRecord) const;
  PictureRecord write_picture(const DrawnFrame&, const render::Picture&) const;

  const RunPaths& paths_;
  const Identity& identity_;
  const SceneDesc& scene_;
  const std::map<int, FrameRecord>& records_;
  const Views& views_;
};

}  // namespace lagomorph::apps
