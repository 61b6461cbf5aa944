def write(about, folder): pass
