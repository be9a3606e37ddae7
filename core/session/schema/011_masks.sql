-- What a person painted in an image for the operation (kind paint): pixels that are its region, and pixels that are not.
-- Both are masks of width x height as LEB128 numbers: lengths of runs of pixels, row by row, alternately not painted and
-- painted; no bytes: nothing. The rest of the image is not painted.
CREATE TABLE mask_corrections (
  operation INTEGER PRIMARY KEY,
  width INTEGER NOT NULL,
  height INTEGER NOT NULL,
  added BLOB NOT NULL,
  removed BLOB NOT NULL,
  row_check INTEGER
);
