-- How often each fragment was seen at all, as a support, and on one: SupportPixels.
ALTER TABLE fragments ADD COLUMN seen_pixels REAL NOT NULL DEFAULT 0;
ALTER TABLE fragments ADD COLUMN support_pixels REAL NOT NULL DEFAULT 0;
ALTER TABLE fragments ADD COLUMN carried_pixels REAL NOT NULL DEFAULT 0;
