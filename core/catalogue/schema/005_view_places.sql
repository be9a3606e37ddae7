-- Where a view's object was: the middle of what was seen of it, metres, in the world of the session that took the view.
-- Null: the view was stored by an older version.
ALTER TABLE view_summaries ADD COLUMN session INTEGER REFERENCES sessions (id);
ALTER TABLE view_summaries ADD COLUMN place_x_m REAL;
ALTER TABLE view_summaries ADD COLUMN place_y_m REAL;
ALTER TABLE view_summaries ADD COLUMN place_z_m REAL;
