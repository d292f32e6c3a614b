#pragma once

#include <string>

#include "room/frame.h"
#include "urto/v1/snapshot.pb.h"

namespace urto::codec {

void write_statistics(const Statistics& statistics, v1::Statistics* out);
// `out` is empty, or was cleared: then its columns keep their memory.
void write_snapshot(const Frame& frame, v1::Snapshot* out);

// Frames to bytes, one after the other, into memory that is used again.
class SnapshotEncoder {
 public:
  // Valid until the next call.
  const std::string& encode(const Frame& frame);

 private:
  v1::Snapshot message_;
  std::string bytes_;
};

}  // namespace urto::codec
