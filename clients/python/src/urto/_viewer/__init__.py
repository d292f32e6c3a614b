"""Shows a room: streams it to Rerun and draws pictures of it. Needs the extra `viewer`."""
