-- The histogram of the object's colours that recognition compares beside the thumbnail: 605 bytes, 5 x 11 x 11 bins of
-- CIELAB, each round(255 * root of its share). Null: an older version stored the view, and it is not computed yet; no
-- bytes: the view has no usable images.
ALTER TABLE descriptors ADD COLUMN colors BLOB;
CREATE INDEX descriptors_without_colors ON descriptors (view) WHERE colors IS NULL;

-- What a network of the user says of a view: `network` is the SHA-256 of its files, `vector` 32-bit floating-point
-- numbers, little-endian, of length 1. Only vectors of the network in use are compared.
CREATE TABLE view_vectors (
  view INTEGER PRIMARY KEY REFERENCES views (id),
  network TEXT NOT NULL,
  vector BLOB NOT NULL
);
