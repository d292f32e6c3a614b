"""Generated protobuf modules; see scripts/generate-proto."""
