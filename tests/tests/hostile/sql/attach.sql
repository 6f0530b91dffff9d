ATTACH '/tmp/hostile.db' AS other
