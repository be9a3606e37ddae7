-- The review of a key frame (its frame's number) by an operation (kind review): open, checked or left-out. The newest
-- operation of a key frame that is done holds; key frames without one are open.
CREATE TABLE frame_reviews (
  operation INTEGER PRIMARY KEY,
  key_frame INTEGER NOT NULL,
  state TEXT NOT NULL,
  row_check INTEGER
);
