-- What became part of the scan from the frame on that is called `first_frame` (frames.number). A frame's number and time
-- in its own recording are frames.source_index - index_shift and frames.time_s - time_shift_s. Older sessions have no row
-- for what they began with.
CREATE TABLE recordings (
  first_frame INTEGER PRIMARY KEY,
  source TEXT NOT NULL,
  index_shift INTEGER NOT NULL,
  time_shift_s REAL NOT NULL,
  row_check INTEGER
);
